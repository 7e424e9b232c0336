#include "sweep_guard/motion/command_period.h"

#include <gtest/gtest.h>

#include "motion/times.h"
#include "refusal.h"

namespace sweep_guard_core {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

TEST(CommandPeriodTest, IsTheBoundBeforeTwoCommands) {
  CommandPeriod period(milliseconds(100));
  EXPECT_EQ(period.longest(), milliseconds(100));
  EXPECT_EQ(period.mean(), milliseconds(100));
  period.add(steadyAt(0));
  EXPECT_EQ(period.longest(), milliseconds(100));
  EXPECT_EQ(period.mean(), milliseconds(100));
}

TEST(CommandPeriodTest, IsMeasuredOverTheNewestIntervals) {
  CommandPeriod period(milliseconds(100));
  period.add(steadyAt(0));
  period.add(steadyAt(40));
  period.add(steadyAt(50));
  EXPECT_EQ(period.longest(), milliseconds(40));
  EXPECT_EQ(period.mean(), milliseconds(25));
  for (int i = 0; i < static_cast<int>(CommandPeriod::kIntervals); ++i) period.add(steadyAt(60 + 10 * i));
  EXPECT_EQ(period.longest(), milliseconds(10));
  EXPECT_EQ(period.mean(), milliseconds(10));
}

TEST(CommandPeriodTest, BeginsAgainAfterAPause) {
  CommandPeriod period(milliseconds(100));
  period.add(steadyAt(0));
  period.add(steadyAt(10));
  period.add(steadyAt(111));
  EXPECT_EQ(period.longest(), milliseconds(100));
  period.add(steadyAt(131));
  EXPECT_EQ(period.longest(), milliseconds(20));
  EXPECT_EQ(period.mean(), milliseconds(20));
}

TEST(CommandPeriodTest, IsNeverShorterThanAMillisecond) {
  CommandPeriod period(milliseconds(100));
  period.add(steadyAt(0));
  period.add(steadyAt(0) + microseconds(10));
  EXPECT_EQ(period.longest(), milliseconds(1));
  EXPECT_EQ(period.mean(), milliseconds(1));
}

TEST(CommandPeriodTest, RefusesABoundBelowAMillisecond) {
  EXPECT_THROW(CommandPeriod{microseconds(999)}, InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_core
