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

std::vector<std::pair<long, double>> play(Replay* replay, int count) {
  std::vector<std::pair<long, double>> played;
  for (int i = 0; i < count; ++i) {
    const auto pose = replay->next();
    if (!pose) break;
    played.emplace_back(std::chrono::duration_cast<seconds>(pose->stamp.time_since_epoch()).count(),
                        pose->X_WT.translation().x());
  }
  return played;
}

using Played = std::vector<std::pair<long, double>>;

TEST(ReplayTest, GivesEveryPoseOnceAtItsIntervalAndEnds) {
  Replay replay({stampedPoseAt(10, 0, 0), stampedPoseAt(11, 1, 0), stampedPoseAt(11, 2, 0), stampedPoseAt(14, 3, 0)},
                {/*loop=*/false});
  EXPECT_EQ(play(&replay, 9), (Played{{0, 0}, {1, 1}, {1, 2}, {4, 3}}));
  EXPECT_FALSE(replay.next());
}

TEST(ReplayTest, LoopsBackAndForthWithoutAJump) {
  Replay replay({stampedPoseAt(10, 0, 0), stampedPoseAt(11, 1, 0), stampedPoseAt(11, 2, 0), stampedPoseAt(14, 3, 0)},
                {/*loop=*/true});
  EXPECT_EQ(play(&replay, 9), (Played{{0, 0}, {1, 1}, {1, 2}, {4, 3}, {7, 2}, {7, 1}, {8, 0}, {9, 1}, {9, 2}}));
}

TEST(ReplayTest, MovesTheLowestTipOfTheFirstSecondsToTheTarget) {
  Replay::Options options;
  options.target_W = {5, 0, 1};
  Replay replay({stampedPoseAt(0, 0, 3), stampedPoseAt(4, 1, 2), stampedPoseAt(6, 2, -7)}, options);
  EXPECT_EQ(replay.next()->X_WT.translation(), Eigen::Vector3d(4, 0, 2));
  EXPECT_EQ(replay.next()->X_WT.translation(), Eigen::Vector3d(5, 0, 1));
}

TEST(ReplayTest, LeavesRotationsAlone) {
  StampedPose turned = stampedPoseAt(0, 0, 0);
  turned.X_WT.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX()).toRotationMatrix();
  Replay replay({turned}, {/*loop=*/false, /*target_W=*/{1, 2, 3}});
  EXPECT_EQ(replay.next()->X_WT.linear(), turned.X_WT.linear());
}

TEST(ReplayTest, RefusesAMotionThatCannotBePlayed) {
  EXPECT_THROW(Replay({}, {}), sweep_guard_core::InvalidInput);
  EXPECT_THROW(Replay({stampedPoseAt(1, 0, 0), stampedPoseAt(1, 1, 0)}, {/*loop=*/true}),
               sweep_guard_core::InvalidInput);
}

}  // namespace
}  // namespace sweep_guard_simulation
