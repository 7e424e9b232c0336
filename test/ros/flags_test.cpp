// On the wall clock: how often ~reflex_warning and ~considered_warning come, and that they do not wait when they rise.
#include <gtest/gtest.h>

#include "guard_probe.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::duration;
using sweep_guard::Warning;

// Of the last messages, which all say the same: no edge came in between.
double rate(const std::vector<GuardProbe::Flag>& flags, size_t intervals) {
  const auto first = flags.end() - static_cast<std::ptrdiff_t>(intervals) - 1;
  for (auto flag = first; flag != flags.end(); ++flag) EXPECT_TRUE(flag->raised);
  return static_cast<double>(intervals) / duration<double>(flags.back().came - first->came).count();
}

TEST(FlagsTest, ComeAtTheirRatesWithoutAnyInput) {
  const GuardProbe probe(/*drives_clock=*/false);
  EXPECT_NEAR(rate(probe.awaitConsideredFlags(6), 5), 1.0, 0.1);
  EXPECT_NEAR(rate(probe.awaitReflexFlags(41), 40), 10.0, 1.0);
}

std::chrono::steady_clock::time_point firstRaised(const std::function<std::vector<GuardProbe::Flag>(size_t)>& await,
                                                  size_t since) {
  for (size_t i = since;; ++i) {
    const GuardProbe::Flag flag = await(i + 1)[i];
    if (flag.raised) return flag.came;
  }
}

// A tick of the timers comes so soon after an edge by chance too, but not after ten of them.
TEST(FlagsTest, ComeAtOnceWhenTheyRise) {
  GuardProbe probe(/*drives_clock=*/false);
  const auto reflex = [&](size_t count) { return probe.awaitReflexFlags(count); };
  const auto considered = [&](size_t count) { return probe.awaitConsideredFlags(count); };
  probe.place(sheetAt("sheet", {0.0, 0.0, -1.0}, ros::Time::now()));
  for (int i = 0; i < 10; ++i) {
    probe.skipWarnings();
    probe.place(sheetMovedTo("sheet", {0.0, 0.0, -1.0}, ros::Time::now()));
    const ros::Time now = ros::Time::now();
    probe.publish(poseAt({0.0, 0.0, 0.5}, now - ros::Duration(0.01)));
    probe.publish(poseAt({0.0, 0.0, 0.5}, now));
    probe.awaitWarning([](const Warning& warning) { return warning.clear; });
    const size_t reflex_before = reflex(0).size();
    const size_t considered_before = considered(0).size();
    probe.awaitWarning([](const Warning& warning) { return warning.reflex && warning.considered; });  // pose too old
    const auto risen = std::chrono::steady_clock::now();
    EXPECT_LT(firstRaised(reflex, reflex_before) - risen, std::chrono::milliseconds(25));
    EXPECT_LT(firstRaised(considered, considered_before) - risen, std::chrono::milliseconds(25));
  }
}

}  // namespace
}  // namespace sweep_guard_ros

int main(int argc, char** argv) {
  ros::init(argc, argv, "flags_test");
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
