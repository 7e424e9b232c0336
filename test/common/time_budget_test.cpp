#include "common/time_budget.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

using std::chrono::milliseconds;

// How often a task that takes `took` runs in a second if it may begin every millisecond.
int timesInASecond(Duration took) {
  TimeBudget budget(0.25, milliseconds(10));
  int times = 0;
  const SteadyTime begin = SteadyTime() + std::chrono::hours(1);
  for (SteadyTime at = begin; at < begin + std::chrono::seconds(1); at += milliseconds(1)) {
    if (at < budget.due()) continue;
    budget.spend(took, at + took);
    ++times;
  }
  return times;
}

TEST(TimeBudgetTest, ATaskTakesItsShareThoughItsBeginsAreRare) {
  EXPECT_NEAR(timesInASecond(std::chrono::microseconds(400)), 625, 10);
  EXPECT_NEAR(timesInASecond(milliseconds(3)), 83, 5);
}

TEST(TimeBudgetTest, AShortTaskIsNotLimited) { EXPECT_EQ(timesInASecond(std::chrono::microseconds(200)), 1000); }

TEST(TimeBudgetTest, OnlyTheNewestTimeIsKept) {
  TimeBudget budget(0.25, milliseconds(10));
  SteadyTime at = SteadyTime() + std::chrono::hours(1);
  int times = 0;
  for (; at >= budget.due(); at += milliseconds(1)) {
    budget.spend(milliseconds(1), at + milliseconds(1));
    ++times;
  }
  EXPECT_EQ(times, 4);  // 3 ms of debt each, 10 ms kept
}

TEST(TimeBudgetTest, WhatWasOwedForLongIsForgotten) {
  TimeBudget budget(0.25, milliseconds(10));
  SteadyTime at = SteadyTime() + std::chrono::hours(1);
  for (int i = 0; i < 100; ++i, at += milliseconds(50)) budget.spend(milliseconds(40), at + milliseconds(40));
  EXPECT_LE(budget.due(), at + milliseconds(130));
}

TEST(TimeBudgetTest, KnowsWhenItAllowsTheTimeAfterTheNext) {
  TimeBudget budget(0.5, milliseconds(0));
  const SteadyTime at = SteadyTime() + std::chrono::hours(1);
  budget.spend(milliseconds(2), at + milliseconds(2));
  EXPECT_EQ(budget.due(), at + milliseconds(4));
  EXPECT_EQ(budget.dueAfterNext(), at + milliseconds(8));
}

}  // namespace
}  // namespace sweep_guard_core
