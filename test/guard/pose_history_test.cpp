#include "guard/pose_history.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace sweep_guard_core
