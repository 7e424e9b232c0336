#include "ros/input/tool_path.h"

#include <vector>

#include "base_and_arm.h"

namespace sweep_guard_ros {
namespace {

class ToolPathTest : public BaseAndArm {
 protected:
  ToolPathTest() {
    frames_.use("tool", parameters_.fixed_frame, {"base"});
    frames_.start(supervisor_);
    placeBase(0.0);
    awaitFrame("base");
  }
  std::optional<sweep_guard_core::Time> push(ros::Time stamp, double z, std::uint64_t static_changes) {
    path_.note(fromMsg(stamp), static_changes);
    std::vector<ArticulatedTool::Pose> poses(1);
    poses[0].stamp = fromMsg(stamp);
    poses[0].X_WT = Eigen::Translation3d(0.0, 0.0, z);
    return path_.push(poses, {std::chrono::steady_clock::now(), monitor_.checkpoint(), base_});
  }
  void moveBase(double z) {
    placeBase(z);
    changed_.get_future().wait();
  }
  std::vector<double> queued() {
    std::vector<sweep_guard_core::QueuedPose> poses;
    queue_.takePoses(poses);
    std::vector<double> z;
    for (const auto& queued : poses) z.push_back(queued.pose.X_WT.translation().z());
    return z;
  }

  sweep_guard_core::WarningMonitor monitor_{parameters_.limits};
  const sweep_guard_core::WorkpieceStore workpieces_;
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_core::FrameMotionStore frame_motions_;
  sweep_guard_core::InputRecord record_;
  MovingFrames moving_frames_{parameters_.fixed_frame, {frames_, frame_motions_, monitor_, queue_, record_}};
  ToolPath path_{parameters_.fixed_frame, {frames_, workpieces_, moving_frames_, monitor_, queue_}};
  const std::string base_ = "base";
  const ros::Time next_ = now_ + ros::Duration(0.01);
};

TEST_F(ToolPathTest, TheMotionToThePoseAfterAChangeIsQueuedInBothPlaces) {
  EXPECT_FALSE(push(now_, 0.5, /*static_changes=*/0));
  moveBase(3.0);
  EXPECT_EQ(push(next_, -0.5, /*static_changes=*/1), fromMsg(next_));
  EXPECT_EQ(queued(), std::vector<double>({0.5, -0.5}));
  ASSERT_TRUE(frames_.applyStaticChanges());
  path_.repeat({}, monitor_.checkpoint());
  EXPECT_EQ(queued(), std::vector<double>({3.5, 2.5}));
}

TEST_F(ToolPathTest, AtAChangeThatNoPoseComesAfterTheNewestIsQueuedAgain) {
  push(now_, 0.5, /*static_changes=*/0);
  moveBase(3.0);
  EXPECT_GT(path_.endAtNewest(/*static_changes=*/1), fromMsg(now_));
  ASSERT_TRUE(frames_.applyStaticChanges());
  path_.repeat({}, monitor_.checkpoint());
  EXPECT_EQ(queued(), std::vector<double>({0.5, 3.5}));
}

TEST_F(ToolPathTest, AChangeBeforeTheFirstPoseRepeatsNothing) {
  moveBase(3.0);
  EXPECT_EQ(path_.endAtNewest(/*static_changes=*/1), sweep_guard_core::Time());
  frames_.applyStaticChanges();
  path_.repeat({}, monitor_.checkpoint());
  EXPECT_TRUE(queued().empty());
}

}  // namespace
}  // namespace sweep_guard_ros
