#include "common/time_share.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// How often a task that takes `took` runs in a second if it may begin every millisecond.
int timesInASecond(Duration took) {
  TimeShare share(0.25, milliseconds(10));
  int times = 0;
  const SteadyTime begin = SteadyTime() + std::chrono::hours(1);
  for (SteadyTime at = begin; at < begin + std::chrono::seconds(1); at += milliseconds(1)) {
    if (at < share.due()) continue;
    share.spend(took, at + took);
    ++times;
  }
  return times;
}

TEST(TimeShareTest, ATaskTakesItsShareThoughItsBeginsAreRare) {
  EXPECT_NEAR(timesInASecond(std::chrono::microseconds(400)), 625, 10);
  EXPECT_NEAR(timesInASecond(milliseconds(3)), 83, 5);
}

TEST(TimeShareTest, AShortTaskIsNotLimited) { EXPECT_EQ(timesInASecond(std::chrono::microseconds(200)), 1000); }

TEST(TimeShareTest, OnlyTheNewestTimeIsKept) {
  TimeShare share(0.25, milliseconds(10));
  SteadyTime at = SteadyTime() + std::chrono::hours(1);
  int times = 0;
  for (; at >= share.due(); at += milliseconds(1)) {
    share.spend(milliseconds(1), at + milliseconds(1));
    ++times;
  }
  EXPECT_EQ(times, 4);  // 3 ms of debt each, 10 ms kept
}

TEST(TimeShareTest, WhatWasOwedForLongIsForgotten) {
  TimeShare share(0.25, milliseconds(10));
  SteadyTime at = SteadyTime() + std::chrono::hours(1);
  for (int i = 0; i < 100; ++i, at += milliseconds(50)) share.spend(milliseconds(40), at + milliseconds(40));
  EXPECT_LE(share.due(), at + milliseconds(130));
}

TEST(TimeShareTest, KnowsWhenItAllowsTheTimeAfterTheNext) {
  TimeShare share(0.5, milliseconds(0));
  const SteadyTime at = SteadyTime() + std::chrono::hours(1);
  share.spend(milliseconds(2), at + milliseconds(2));
  EXPECT_EQ(share.due(), at + milliseconds(4));
  EXPECT_EQ(share.dueAfterNext(), at + milliseconds(8));
}

}  // namespace
}  // namespace sweep_guard_core
