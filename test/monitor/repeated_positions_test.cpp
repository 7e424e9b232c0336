#include "monitor/repeated_positions.h"

#include <gtest/gtest.h>

namespace sweep_guard_core {
namespace {

Eigen::Isometry3d inPlace(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.5)); }

TEST(RepeatedPositionsTest, AToolThatIsSentFourTimesAsOftenAsItIsMeasuredRepeatsThreeOfFour) {
  RepeatedPositions repeats;
  for (int i = 0; i < 41; ++i) repeats.add(inPlace(0.01 * (i / 4)), {});
  EXPECT_EQ(repeatedPercent({}, repeats.counts()), 75.0);
}

TEST(RepeatedPositionsTest, AToolThatMovesWithEachStateRepeatsNoneAndOneAtRestAll) {
  RepeatedPositions repeats;
  for (int i = 0; i <= 10; ++i) repeats.add(inPlace(1e-12 * i), {});
  const RepeatedPositions::Counts moved = repeats.counts();
  EXPECT_EQ(repeatedPercent({}, moved), 0.0);
  for (int i = 0; i < 5; ++i) repeats.add(inPlace(1e-11), {});
  EXPECT_EQ(repeatedPercent(moved, repeats.counts()), 100.0);
}

TEST(RepeatedPositionsTest, JointsThatMoveAreNoRepetition) {
  RepeatedPositions repeats;
  for (int i = 0; i <= 4; ++i) repeats.add(inPlace(0.0), {0.3, 0.1 * (i / 2)});
  EXPECT_EQ(repeatedPercent({}, repeats.counts()), 50.0);
}

TEST(RepeatedPositionsTest, WithoutAStateInBetweenThereIsNoShare) {
  RepeatedPositions repeats;
  EXPECT_EQ(repeatedPercent({}, repeats.counts()), std::nullopt);
  repeats.add(inPlace(0.0), {});
  EXPECT_EQ(repeatedPercent({}, repeats.counts()), std::nullopt);
}

}  // namespace
}  // namespace sweep_guard_core
