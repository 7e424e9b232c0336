#include "recording/swept_intervals.h"

#include <gtest/gtest.h>

namespace sweep_guard_recording {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::Time;

Time at(int ms) { return Time(milliseconds(ms)); }

TEST(SweptIntervalsTest, GapsBetweenThemAreSummed) {
  SweptIntervals swept;
  swept.add(at(0), at(0));
  swept.add(at(0), at(10));
  swept.add(at(10), at(30));
  EXPECT_EQ(swept.gaps(), milliseconds(0));
  swept.add(at(35), at(40));
  EXPECT_EQ(swept.gaps(), milliseconds(5));
  EXPECT_EQ(swept.size(), 4U);
  EXPECT_EQ(swept.first(), at(0));
  EXPECT_EQ(swept.last(), at(40));
}

TEST(SweptIntervalsTest, CoverPosesInsideAndAtTheirEnd) {
  SweptIntervals swept;
  swept.add(at(10), at(10));
  swept.add(at(10), at(30));
  swept.add(at(40), at(50));
  for (const int covered : {10, 20, 30, 45, 50}) EXPECT_TRUE(swept.covers(at(covered))) << covered;
  for (const int outside : {9, 35, 40, 51}) EXPECT_FALSE(swept.covers(at(outside))) << outside;
}

TEST(SweptIntervalsTest, OfPosesWithEqualStampsTheIntervalOfTheFirstCounts) {
  SweptIntervals swept;
  swept.add(at(0), at(20));
  swept.add(at(20), at(20));
  EXPECT_TRUE(swept.covers(at(10)));
  EXPECT_EQ(swept.size(), 2U);
}

TEST(SweptIntervalsTest, CoverNothingWhenNothingWasSwept) {
  const SweptIntervals swept;
  EXPECT_FALSE(swept.covers(at(0)));
  EXPECT_FALSE(swept.first());
  EXPECT_FALSE(swept.last());
}

}  // namespace
}  // namespace sweep_guard_recording
