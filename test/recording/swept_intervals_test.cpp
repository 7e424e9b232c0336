#include "recording/swept_intervals.h"

#include <gtest/gtest.h>

#include "timeline.h"

namespace sweep_guard_recording {
namespace {

using namespace sweep_guard_core::timeline;
using std::chrono::milliseconds;

SweptIntervals sweptOver(const std::vector<std::pair<int, int>>& intervals) {
  SweptIntervals swept;
  for (const auto& [start, stamp] : intervals) swept.add(at(start), at(stamp));
  return swept;
}

TEST(SweptIntervalsTest, GapsBetweenThemAreSummed) {
  SweptIntervals swept = sweptOver({{0, 0}, {0, 10}, {10, 30}});
  EXPECT_EQ(swept.gaps(), milliseconds(0));
  swept.add(at(35), at(40));
  EXPECT_EQ(swept.gaps(), milliseconds(5));
  EXPECT_EQ(swept.size(), 4U);
  EXPECT_EQ(swept.first(), at(0));
  EXPECT_EQ(swept.last(), at(40));
}

TEST(SweptIntervalsTest, CoverPosesInsideAndAtTheirEnd) {
  const SweptIntervals swept = sweptOver({{10, 10}, {10, 30}, {40, 50}});
  for (const int covered : {10, 20, 30, 45, 50}) EXPECT_TRUE(swept.covers(at(covered))) << covered;
  for (const int outside : {9, 35, 40, 51}) EXPECT_FALSE(swept.covers(at(outside))) << outside;
}

TEST(SweptIntervalsTest, OfPosesWithEqualStampsTheIntervalOfTheFirstCounts) {
  const SweptIntervals swept = sweptOver({{0, 20}, {20, 20}});
  EXPECT_TRUE(swept.covers(at(10)));
  EXPECT_EQ(swept.size(), 2U);
}

TEST(SweptIntervalsTest, TheLongestIsOfAllOfThem) {
  EXPECT_EQ(SweptIntervals().longest(), milliseconds(0));
  EXPECT_EQ(sweptOver({{10, 10}, {10, 30}, {40, 50}}).longest(), milliseconds(20));
  EXPECT_EQ(sweptOver({{10, 15}, {12, 15}, {20, 29}}).longest(), milliseconds(9));
}

TEST(SweptIntervalsTest, CoverNothingWhenNothingWasSwept) {
  const SweptIntervals swept;
  EXPECT_FALSE(swept.covers(at(0)));
  EXPECT_FALSE(swept.first());
  EXPECT_FALSE(swept.last());
}

}  // namespace
}  // namespace sweep_guard_recording
