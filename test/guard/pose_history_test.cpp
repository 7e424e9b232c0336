#include "guard/pose_history.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes.h"

namespace sweep_guard_core {
namespace {

using namespace std::chrono_literals;

PoseSample sampleOf(int number, Duration stamp) {
  const auto there = [&](double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)); };
  return {static_cast<std::uint64_t>(number), Time(stamp), there(number), there(0)};
}

PoseHistory historyOf(int count) {
  PoseHistory history;
  for (int i = 0; i < count; ++i) history.add(sampleOf(i, i * 10ms));
  return history;
}

TEST(PoseHistoryTest, KeepsItsPosesWhileItsBeginIsForgotten) {
  PoseHistory history;
  for (int i = 0; i < 1000; ++i) {
    history.add(sampleOf(i, i * 10ms));
    if (history.size() > 7) history.forgetFirst();
    for (size_t k = 0; k < history.size(); ++k)
      ASSERT_EQ(history[k].number, static_cast<size_t>(i) + 1 - history.size() + k);
    ASSERT_EQ(history.newest().number, static_cast<size_t>(i));
  }
  EXPECT_EQ(history.size(), 7U);
}

TEST(PoseHistoryTest, GoesStraightPastItsSecondPoseWhenItIsTooLong) {
  PoseHistory history = historyOf(PoseHistory::kMaxSize + 3);
  EXPECT_EQ(history.size(), PoseHistory::kMaxSize);
  EXPECT_EQ(history[0].number, 0U);
  EXPECT_EQ(history[1].number, 4U);
}

TEST(PoseHistoryTest, FindsPosesByNumberAndStamp) {
  PoseHistory history = historyOf(10);
  history.forgetFirst();
  EXPECT_EQ(history.lastUpTo(std::uint64_t{0}), 0U);
  EXPECT_EQ(history.lastUpTo(std::uint64_t{1}), 0U);
  EXPECT_EQ(history.lastUpTo(std::uint64_t{5}), 4U);
  EXPECT_EQ(history.lastUpTo(std::uint64_t{99}), 8U);
  EXPECT_EQ(history.lastUpTo(Time(5ms)), 0U);
  EXPECT_EQ(history.lastUpTo(Time(30ms)), 2U);
  EXPECT_EQ(history.lastUpTo(Time(39ms)), 2U);
  history.add(sampleOf(10, 90ms));
  EXPECT_EQ(history.lastUpTo(Time(90ms)), 9U);
}

TEST(PoseHistoryTest, SharesAreOfTime) {
  PoseHistory history;
  for (const Duration stamp : {0ms, 10ms, 40ms, 50ms}) history.add(sampleOf(1, stamp));
  EXPECT_EQ(history.share(1, 0, Time(50ms)), 0.0);
  EXPECT_EQ(history.share(1, 1, Time(50ms)), 0.0);
  EXPECT_EQ(history.share(1, 2, Time(50ms)), 0.75);
  EXPECT_EQ(history.share(1, 3, Time(50ms)), 1.0);
  EXPECT_EQ(history.share(1, 3, Time(90ms)), 0.5);
  history.add(sampleOf(2, 50ms));
  EXPECT_EQ(history.share(3, 4, Time(50ms)), 1.0);
}

// The frame turns by half a radian under a tool that rests a metre beside its origin.
TEST(PoseHistoryTest, IsExpressedInTheFrame) {
  PoseHistory history;
  history.add({1, Time(1s), Eigen::Isometry3d(Eigen::Translation3d(1, 0, 0)), Eigen::Isometry3d::Identity()});
  PoseSample next = history.newest();
  next.stamp = Time(2s);
  next.X_WM = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ());
  history.add(next);
  Path path_M(5);
  history.path_M(0, 1, /*tool_radius=*/0.2, path_M);
  ASSERT_EQ(path_M.size(), 2U);
  EXPECT_EQ(path_M[0].deviation_bound, 0.0);
  EXPECT_EQ(path_M[1].time, 1s);
  EXPECT_NEAR(path_M[1].deviation_bound, 0.3 / 8.0, 1e-12);
  EXPECT_TRUE(path_M[1].X_MT.translation().isApprox(Eigen::Vector3d(std::cos(0.5), -std::sin(0.5), 0)));
}

TEST(PoseHistoryTest, ItsBoundsHoldThePathThatAPointTakes) {
  Random random(/*seed=*/4);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("path " + std::to_string(i));
    PoseHistory history;
    const double reach = random.chance(0.5) ? 0.1 : 1.0;  // [rad]
    PoseSample sample{1, Time(0ms), random.pose(random.inBox({1, 1, 1})), random.pose(random.inBox({1, 1, 1}))};
    for (int k = 0; k < 3; ++k) {
      history.add(sample);
      for (Eigen::Isometry3d* const X : {&sample.X_WT, &sample.X_WM})
        *X = Eigen::Translation3d(random.inBox({0.1, 0.1, 0.1})) * *X * Eigen::Isometry3d(random.turn(reach));
    }
    const Eigen::Vector3d point_T = random.inBox({0.2, 0.2, 0.2});
    const PoseBounds bounds = history.bounds_M(0, 2, point_T, point_T.norm());
    for (size_t k = 1; k < 3; ++k) {
      const Motion tool{history[k - 1].X_WT, history[k].X_WT};
      const Motion frame{history[k - 1].X_WM, history[k].X_WM};
      for (int step = 0; step <= 20; ++step) {
        const Eigen::Vector3d point_M = frame.at(step / 20.0).inverse() * (tool.at(step / 20.0) * point_T);
        EXPECT_LE(bounds.point_M.exteriorDistance(point_M), bounds.deviation);
      }
    }
  }
}

// Each of three motions deviates in another way.
TEST(PoseHistoryTest, ItsBoundsDeviateAsTheMotionThatDeviatesMost) {
  PoseHistory history = historyOf(2);
  EXPECT_NEAR(history.bounds_M(0, 1, {0, 0, 0}, 0.5).deviation, 0.0, 1e-12);
  PoseSample next = history.newest();
  next.deviation_bound = 0.25;
  history.add(next);
  EXPECT_NEAR(history.bounds_M(0, 2, {0, 0, 0}, 0.5).deviation, 0.25, 1e-12);
  EXPECT_NEAR(history.bounds_M(2, 2, {0, 0, 0}, 0.5).deviation, 0.25, 1e-12);
  next.deviation_bound = 0.0;
  next.X_WT.linear() = Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  history.add(next);
  Path path_M;
  history.path_M(2, 3, 0.5, path_M);
  EXPECT_GE(history.bounds_M(0, 3, {0, 0, 0}, 0.5).deviation, path_M[1].deviation_bound);
}

}  // namespace
}  // namespace sweep_guard_core
