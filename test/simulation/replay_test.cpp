#include "simulation/pose_stream.h"

#include <gtest/gtest.h>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {
namespace {

using std::chrono::seconds;
using sweep_guard_core::StampedPose;

StampedPose stampedPoseAt(int stamp, double x, double z) {
  StampedPose pose;
  pose.stamp = sweep_guard_core::Time(seconds(stamp));
  pose.X_WT.translation() << x, 0, z;
  return pose;
}

std::vector<std::pair<long, double>> play(const PoseStream& replay, int count) {
  std::vector<std::pair<long, double>> played;
  for (int i = 0; i < count; ++i) {
    const auto pose = replay();
    if (!pose) break;
    played.emplace_back(std::chrono::duration_cast<seconds>(pose->stamp.time_since_epoch()).count(),
                        pose->X_WT.translation().x());
  }
  return played;
}

std::vector<StampedPose> fourPoses() {
  return {stampedPoseAt(10, 0, 0), stampedPoseAt(11, 1, 0), stampedPoseAt(11, 2, 0), stampedPoseAt(14, 3, 0)};
}

using Played = std::vector<std::pair<long, double>>;

TEST(ReplayTest, GivesEveryPoseOnceAtItsIntervalAndEnds) {
  const PoseStream replay = replayed(fourPoses(), /*loop=*/false, Eigen::Vector3d::Zero());
  EXPECT_EQ(play(replay, 9), (Played{{0, 0}, {1, 1}, {1, 2}, {4, 3}}));
  EXPECT_FALSE(replay());
}

TEST(ReplayTest, LoopsBackAndForthWithoutAJump) {
  const PoseStream replay = replayed(fourPoses(), /*loop=*/true, Eigen::Vector3d::Zero());
  EXPECT_EQ(play(replay, 9), (Played{{0, 0}, {1, 1}, {1, 2}, {4, 3}, {7, 2}, {7, 1}, {8, 0}, {9, 1}, {9, 2}}));
}

TEST(ReplayTest, MovesTheLowestTipOfTheFirstSecondsToTheTarget) {
  const PoseStream replay =
      replayed({stampedPoseAt(0, 0, 3), stampedPoseAt(4, 1, 2), stampedPoseAt(6, 2, -7)}, /*loop=*/true, {5, 0, 1});
  EXPECT_EQ(replay()->X_WT.translation(), Eigen::Vector3d(4, 0, 2));
  EXPECT_EQ(replay()->X_WT.translation(), Eigen::Vector3d(5, 0, 1));
}

TEST(ReplayTest, LeavesRotationsAlone) {
  StampedPose turned = stampedPoseAt(0, 0, 0);
  turned.X_WT.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const PoseStream replay = replayed({turned}, /*loop=*/false, /*target_W=*/{1, 2, 3});
  EXPECT_EQ(replay()->X_WT.linear(), turned.X_WT.linear());
}

TEST(ReplayTest, RefusesAMotionThatCannotBePlayed) {
  const Eigen::Vector3d target_W = Eigen::Vector3d::Zero();
  EXPECT_THROW(replayed({}, /*loop=*/true, target_W), sweep_guard_core::InvalidInput);
  EXPECT_THROW(replayed({stampedPoseAt(1, 0, 0), stampedPoseAt(1, 1, 0)}, /*loop=*/true, target_W),
               sweep_guard_core::InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_simulation
