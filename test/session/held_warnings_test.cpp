#include "session/held_warnings.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <tuple>
#include <utility>

#include "timeline.h"

namespace sweep_guard_session {
namespace {

using namespace sweep_guard_core::timeline;
using std::chrono::milliseconds;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

constexpr int kEnd = 8000;                     // [ms] of the session
constexpr int kPeriod = 2;                     // [ms] between poses
constexpr Duration kHold = milliseconds(500);  // warning/hold_time

GuardWarning toldAt(int computed, int pose, WarningLevel level, const std::string& text = {}) {
  return {at(computed), at(pose), level, text, {}, {}};
}

GuardWarning heldAt(int computed, int pose, WarningLevel level, int over_for) {
  return {at(computed), at(pose), level, "held", {}, milliseconds(over_for)};
}

SessionLog heldLog(const std::vector<GuardWarning>& warnings, const std::vector<Time>& touches, int end,
                   Duration hold = kHold) {
  SessionLog log;
  for (const LoggedWarning& warning : holdWarnings(warnings, touches, hold, at(end))) log.add(warning);
  log.end(at(end));
  return log;
}

// Level and bounds [ms] of each segment.
using Bounds = std::vector<std::tuple<WarningLevel, int, int>>;
Bounds boundsOf(const SessionLog& log) {
  const auto ms = [](Time time) { return static_cast<int>((time - at(0)) / milliseconds(1)); };
  Bounds bounds;
  for (const Segment& segment : log.segments()) bounds.emplace_back(segment.level, ms(segment.begin), ms(segment.end));
  return bounds;
}

TEST(HeldWarningsTest, AContactLastsFromItsPoseToTheHoldTimeAfterTheLastThatTouched) {
  const std::vector<GuardWarning> prompt = {toldAt(0, 0, kClear), toldAt(1000, 1000, kContact),
                                            heldAt(1200, 1200, kContact, 0), toldAt(1700, 1700, kClear)};
  const std::vector<GuardWarning> late = {toldAt(0, 0, kClear), toldAt(1800, 1000, kContact),
                                          heldAt(2900, 1200, kContact, 0), toldAt(3000, 3000, kClear)};
  const std::vector<GuardWarning> held_for_too_long = {toldAt(0, 0, kClear), toldAt(1000, 1000, kContact),
                                                       heldAt(1200, 1200, kContact, 0), toldAt(3200, 3200, kClear)};
  for (const auto& warnings : {prompt, late, held_for_too_long}) {
    const SessionLog log = heldLog(warnings, {at(1000), at(1190)}, 4000);
    EXPECT_EQ(boundsOf(log), (Bounds{{kClear, 0, 1000}, {kContact, 1000, 1690}, {kClear, 1690, 4000}}));
  }
}

TEST(HeldWarningsTest, AContactWithoutFurtherPosesLasts) {
  const std::vector<GuardWarning> gap = {toldAt(0, 0, kClear), toldAt(1000, 1000, kContact),
                                         toldAt(2000, 1000, kContact), toldAt(3000, 2990, kClear)};
  EXPECT_EQ(boundsOf(heldLog(gap, {at(1000)}, 4000)),
            (Bounds{{kClear, 0, 1000}, {kContact, 1000, 2990}, {kClear, 2990, 4000}}));
  const std::vector<GuardWarning> end = {toldAt(0, 0, kClear), toldAt(1000, 1000, kContact)};
  EXPECT_EQ(boundsOf(heldLog(end, {at(1000)}, 4000)), (Bounds{{kClear, 0, 1000}, {kContact, 1000, 4000}}));
  const std::vector<GuardWarning> all = {toldAt(100, 90, kContact), toldAt(2000, 2000, kContact)};
  EXPECT_EQ(boundsOf(heldLog(all, {at(90), at(2000)}, 4000)), (Bounds{{kContact, 100, 4000}}));
}

TEST(HeldWarningsTest, ContactsThatAreApartStayApart) {
  const auto twice = [](int again) {
    return std::vector<GuardWarning>{toldAt(0, 0, kClear), toldAt(1000, 1000, kContact),
                                     heldAt(1100, 1100, kContact, 0), toldAt(again, again, kContact),
                                     heldAt(again + 100, again + 100, kContact, 0)};
  };
  for (const int again : {1700, 2500, 3000}) {
    const SessionLog log = heldLog(twice(again), {at(1000), at(again)}, 4000);
    EXPECT_EQ(log.contacts().size(), 2U) << again;
    EXPECT_EQ(log.duration(kContact), milliseconds(1000)) << again;
  }
  const SessionLog one = heldLog(twice(1400), {at(1000), at(1400)}, 4000);
  EXPECT_EQ(boundsOf(one), (Bounds{{kClear, 0, 1000}, {kContact, 1000, 1900}, {kUnknown, 1900, 4000}}));
}

TEST(HeldWarningsTest, APredictionIsHeldAfterItsEnd) {
  const std::vector<GuardWarning> warnings = {toldAt(0, 0, kClear), toldAt(1000, 990, kReflex),
                                              toldAt(1100, 1090, kConsidered), toldAt(1800, 1790, kClear)};
  EXPECT_EQ(boundsOf(heldLog(warnings, {}, 4000)),
            (Bounds{{kClear, 0, 1000}, {kReflex, 1000, 1600}, {kConsidered, 1600, 2300}, {kClear, 2300, 4000}}));
  EXPECT_EQ(boundsOf(heldLog(warnings, {}, 4000, Duration(0))),
            (Bounds{{kClear, 0, 1000}, {kReflex, 1000, 1100}, {kConsidered, 1100, 1800}, {kClear, 1800, 4000}}));
  const std::vector<GuardWarning> beneath = {toldAt(0, 0, kContact), heldAt(100, 100, kContact, 0),
                                             heldAt(350, 350, kReflex, 50), toldAt(550, 550, kUnknown)};
  EXPECT_EQ(boundsOf(heldLog(beneath, {at(0)}, 2000)),
            (Bounds{{kContact, 0, 500}, {kReflex, 500, 800}, {kUnknown, 800, 2000}}));
}

TEST(HeldWarningsTest, TextsAreThoseOfTheLevelThatCounts) {
  const std::vector<LoggedWarning> held = holdWarnings({toldAt(0, 0, kUnknown, "a"), toldAt(100, 90, kReflex, "b"),
                                                        toldAt(200, 190, kClear, "c"), toldAt(200, 190, kClear, "d")},
                                                       {}, kHold, at(1000));
  ASSERT_EQ(held.size(), 3U);
  EXPECT_EQ(held[0].text, "a");
  EXPECT_EQ(held[1].text, "b");
  EXPECT_EQ(held[2].received, at(700));
  EXPECT_EQ(held[2].text, "d");
  EXPECT_TRUE(holdWarnings({}, {}, kHold, at(1000)).empty());
  EXPECT_TRUE(holdWarnings({toldAt(1000, 0, kClear)}, {}, kHold, at(1000)).empty());
}

// What the tool does at a time [ms] of the session: it bounces, comes near and goes away.
bool touchesAt(int ms) { return (ms >= 1000 && ms < 1130) || (ms >= 1400 && ms < 1404) || (ms >= 4500 && ms < 4620); }
WarningLevel predictedAt(int ms) {
  if ((ms >= 900 && ms < 1500) || (ms >= 4400 && ms < 4560)) return kReflex;
  if ((ms >= 300 && ms < 2200) || (ms >= 3700 && ms < 4700) || (ms >= 6000 && ms < 6300)) return kConsidered;
  return kClear;
}

/// A guard whose clock is that of the machine, in which the session runs at a rate. It holds contacts and predictions, tells the
/// highest level on each change, and may be late.
class SimulatedGuard {
 public:
  using Lag = std::function<double(int)>;  // [ms] of the machine, by the time of the session [ms]

  SimulatedGuard(double rate, double hold, Lag lag) : rate_(rate), hold_(hold), lag_(std::move(lag)) {
    over_.fill(-1e9);
    for (int pose = 0; pose < kEnd; pose += kPeriod) sweep(pose);
  }

  std::vector<GuardWarning> warnings;
  std::vector<Time> touches;

 private:
  // A pose waits for the one before it. Predictions count from now.
  void sweep(int pose) {
    computed_ = std::max(computed_, pose + rate_ * lag_(pose));
    const WarningLevel predicted = predictedAt(static_cast<int>(computed_));
    if (touchesAt(pose)) touches.push_back(at(pose));
    for (const WarningLevel level : {kConsidered, kReflex, kContact}) {
      const bool lasts = level == kContact ? touchesAt(pose) : predicted == level;
      if (lasts) over_.at(static_cast<std::size_t>(level)) = computed_;
    }
    tell(pose, touchesAt(pose) ? kContact : predicted);
  }

  void tell(int pose, WarningLevel now) {
    GuardWarning warning = toldAt(static_cast<int>(computed_), pose, now);
    for (const WarningLevel level : {kContact, kReflex, kConsidered}) {
      const double over_for = computed_ - over_.at(static_cast<std::size_t>(level));
      if (level <= now || over_for > rate_ * hold_) continue;
      warning = heldAt(static_cast<int>(computed_), pose, level, static_cast<int>(over_for));
      break;
    }
    const bool same = !warnings.empty() && warnings.back().level == warning.level &&
                      warnings.back().over_for.has_value() == warning.over_for.has_value();
    if (!same) warnings.push_back(warning);
  }

  double rate_;
  double hold_;  // [ms] of the machine
  Lag lag_;
  double computed_ = 0.0;         // [ms] of the session
  std::array<double, 5> over_{};  // [ms] of the session, by level: when it last was
};

double shareOf(const SessionLog& log, WarningLevel level) {
  return sweep_guard_core::toSeconds(log.duration(level)) / (1e-3 * kEnd);
}

// The guard holds for half of the hold time by its own clock, or for 0.5 s if it cannot be set.
TEST(HeldWarningsTest, SharesOfLevelsDoNotDependOnTheRate) {
  const auto prompt = [](int) { return 0.5; };
  const SimulatedGuard as_recorded(1.0, 500.0, prompt);
  const SessionLog expected = heldLog(as_recorded.warnings, as_recorded.touches, kEnd);
  EXPECT_NEAR(shareOf(expected, kContact), (0.404 + 0.5 + 0.62) / 8.0, 0.002);
  for (const double rate : {0.1, 0.5, 1.0, 2.0, 4.0, 20.0}) {
    const SimulatedGuard guard(rate, 250.0 / rate, prompt);
    const SessionLog log = heldLog(guard.warnings, guard.touches, kEnd);
    EXPECT_EQ(log.contacts().size(), 2U) << rate;
    for (const WarningLevel level : {kClear, kConsidered, kReflex, kContact}) {
      EXPECT_NEAR(shareOf(log, level), shareOf(expected, level), 0.01) << rate;
    }
  }
}

TEST(HeldWarningsTest, ContactsDoNotDependOnLoad) {
  const std::array<SimulatedGuard::Lag, 3> loads = {[](int) { return 40.0; },
                                                    [](int ms) { return ms > 1100 && ms < 2000 ? 300.0 : 1.0; },
                                                    [](int ms) { return 100.0 + 90.0 * std::sin(0.01 * ms); }};
  for (const SimulatedGuard::Lag& lag : loads) {
    for (const auto& [rate, hold] : {std::pair(1.0, 500.0), std::pair(4.0, 62.5), std::pair(4.0, 500.0)}) {
      const SimulatedGuard guard(rate, hold, lag);
      const SessionLog log = heldLog(guard.warnings, guard.touches, kEnd);
      ASSERT_EQ(log.contacts().size(), 2U) << rate;
      EXPECT_EQ(log.contacts()[0].begin, at(1000)) << rate;
      EXPECT_EQ(log.contacts()[1].begin, at(4500)) << rate;
      EXPECT_NEAR(shareOf(log, kContact), (0.404 + 0.5 + 0.62) / 8.0, 0.002) << rate;
    }
  }
}

}  // namespace
}  // namespace sweep_guard_session
