// ~reflex_warning and ~considered_warning on the wall clock: their rates, and that a rising flag is not delayed.
#include <gtest/gtest.h>

#include "guard_probe.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::duration;
using sweep_guard::Warning;
using sweep_guard_core::quantile;

// Rate of the last messages, which have the same value: no edge is among them.
double rate(const std::vector<GuardProbe::Flag>& flags, size_t intervals) {
  const auto first = flags.end() - static_cast<std::ptrdiff_t>(intervals) - 1;
  for (auto flag = first; flag != flags.end(); ++flag) EXPECT_TRUE(flag->raised);
  return static_cast<double>(intervals) / duration<double>(flags.back().received - first->received).count();
}

TEST(FlagsTest, HaveTheirRatesWithoutAnyInput) {
  const GuardProbe probe(/*drives_clock=*/false);
  EXPECT_NEAR(rate(probe.awaitConsideredFlags(6), 5), 1.0, 0.1);
  EXPECT_NEAR(rate(probe.awaitReflexFlags(41), 40), 10.0, 1.0);
}

std::chrono::steady_clock::time_point firstRaised(const std::function<std::vector<GuardProbe::Flag>(size_t)>& await,
                                                  size_t since) {
  for (size_t i = since;; ++i) {
    const GuardProbe::Flag flag = await(i + 1)[i];
    if (flag.raised) return flag.received;
  }
}

// A timer may fire soon after an edge by chance, but not after 18 of 21 edges. Load delays a few.
TEST(FlagsTest, ArePublishedAtOnceWhenTheyRise) {
  GuardProbe probe(/*drives_clock=*/false);
  const auto reflex = [&](size_t count) { return probe.awaitReflexFlags(count); };
  const auto considered = [&](size_t count) { return probe.awaitConsideredFlags(count); };
  probe.place(squareAt("square", {0.0, 0.0, -1.0}, ros::Time::now()));
  std::vector<double> reflex_late;      // [s]
  std::vector<double> considered_late;  // [s]
  for (int i = 0; i < 21; ++i) {
    do {  // until it is clear: on a busy machine a pose may be stale before
      probe.place(squareMovedTo("square", {0.0, 0.0, -1.0}, ros::Time::now()));
      probe.publish(poseAt({0.0, 0.0, 0.5}, ros::Time::now()));
      probe.skipWarnings();
    } while (!probe.awaitWarning([](const Warning&) { return true; }).clear);
    const size_t reflex_before = reflex(0).size();
    const size_t considered_before = considered(0).size();
    probe.awaitWarning([](const Warning& warning) { return warning.reflex && warning.considered; });  // pose too old
    const auto risen = std::chrono::steady_clock::now();
    reflex_late.push_back(duration<double>(firstRaised(reflex, reflex_before) - risen).count());
    considered_late.push_back(duration<double>(firstRaised(considered, considered_before) - risen).count());
  }
  for (const auto& late : {reflex_late, considered_late}) {
    EXPECT_LT(quantile(late, 0.5), 0.01) << ::testing::PrintToString(late);
    EXPECT_LT(quantile(late, 0.85), 0.025) << ::testing::PrintToString(late);
  }
}

}  // namespace
}  // namespace sweep_guard_ros
