#include "sweep_guard/guard/way.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sweep_guard {
namespace {

using namespace std::chrono_literals;

Placed placed(int number, Duration stamp) {
  const auto there = [&](double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)); };
  return {static_cast<std::uint64_t>(number), Time(stamp), there(number), there(0)};
}

Way wayOf(int count) {
  Way way;
  for (int i = 0; i < count; ++i) way.add(placed(i, i * 10ms));
  return way;
}

TEST(WayTest, KeepsItsPosesWhileItsBeginIsForgotten) {
  Way way;
  for (int i = 0; i < 1000; ++i) {
    way.add(placed(i, i * 10ms));
    if (way.size() > 7) way.forgetFirst();
    for (size_t k = 0; k < way.size(); ++k) ASSERT_EQ(way[k].number, static_cast<size_t>(i) + 1 - way.size() + k);
    ASSERT_EQ(way.newest().number, static_cast<size_t>(i));
  }
  EXPECT_EQ(way.size(), 7U);
}

TEST(WayTest, GoesStraightPastItsSecondPoseWhenItIsTooLong) {
  Way way = wayOf(Way::kLongest + 3);
  EXPECT_EQ(way.size(), Way::kLongest);
  EXPECT_EQ(way[0].number, 0U);
  EXPECT_EQ(way[1].number, 4U);
}

TEST(WayTest, FindsPosesByNumberAndStamp) {
  Way way = wayOf(10);
  way.forgetFirst();
  EXPECT_EQ(way.lastUpTo(std::uint64_t{0}), 0U);
  EXPECT_EQ(way.lastUpTo(std::uint64_t{1}), 0U);
  EXPECT_EQ(way.lastUpTo(std::uint64_t{5}), 4U);
  EXPECT_EQ(way.lastUpTo(std::uint64_t{99}), 8U);
  EXPECT_EQ(way.lastUpTo(Time(5ms)), 0U);
  EXPECT_EQ(way.lastUpTo(Time(30ms)), 2U);
  EXPECT_EQ(way.lastUpTo(Time(39ms)), 2U);
  way.add(placed(10, 90ms));
  EXPECT_EQ(way.lastUpTo(Time(90ms)), 9U);
}

TEST(WayTest, SharesAreOfTime) {
  Way way;
  for (const Duration stamp : {0ms, 10ms, 40ms, 50ms}) way.add(placed(1, stamp));
  EXPECT_EQ(way.share(1, 0), 0.0);
  EXPECT_EQ(way.share(1, 1), 0.0);
  EXPECT_EQ(way.share(1, 2), 0.75);
  EXPECT_EQ(way.share(1, 3), 1.0);
  way.add(placed(2, 50ms));
  EXPECT_EQ(way.share(3, 4), 1.0);
}

// The frame turns by half a radian under a tool that rests a metre beside its origin.
TEST(WayTest, IsSeenFromTheFrame) {
  Way way;
  way.add({1, Time(1s), Eigen::Isometry3d(Eigen::Translation3d(1, 0, 0)), Eigen::Isometry3d::Identity()});
  Placed next = way.newest();
  next.stamp = Time(2s);
  next.X_WM = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ());
  way.add(next);
  Waypoints waypoints_M(5);
  way.waypoints_M(0, 1, /*tool_extent=*/0.2, waypoints_M);
  ASSERT_EQ(waypoints_M.size(), 2U);
  EXPECT_EQ(waypoints_M[0].arc, 0.0);
  EXPECT_EQ(waypoints_M[1].time, 1s);
  EXPECT_NEAR(waypoints_M[1].arc, 0.3 / 8.0, 1e-12);
  EXPECT_TRUE(waypoints_M[1].X_MT.translation().isApprox(Eigen::Vector3d(std::cos(0.5), -std::sin(0.5), 0)));
}

}  // namespace
}  // namespace sweep_guard
