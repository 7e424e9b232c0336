#include "ros/input/tool_path.h"

#include <utility>
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
    std::vector<sweep_guard_core::PoseWithFrames> poses = {
        {fromMsg(stamp), std::chrono::steady_clock::now(), Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z))}};
    const auto changed_from = path_.place(poses, base_, monitor_.checkpoint(), placed_);
    queue();
    return changed_from;
  }
  void moveBase(double z) {
    placeBase(z);
    changed_.get_future().wait();
  }
  void repeat() {
    path_.repeat({}, monitor_.checkpoint(), placed_);
    queue();
  }
  void queue() {
    for (const auto& placed : placed_) queued_.push_back(placed.pose.X_WT.translation().z());
  }
  std::vector<double> queued() { return std::exchange(queued_, {}); }

  sweep_guard_core::WarningMonitor monitor_{parameters_.limits};
  const sweep_guard_core::WorkpieceStore workpieces_;
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_core::FrameMotionStore frame_motions_;
  sweep_guard_core::InputRecord record_;
  MovingFrames moving_frames_{parameters_.fixed_frame, {frames_, frame_motions_, monitor_, queue_, record_}};
  ToolPath path_{parameters_.fixed_frame, frames_, workpieces_, moving_frames_};
  std::vector<sweep_guard_core::QueuedPose> placed_;
  std::vector<double> queued_;
  const std::string base_ = "base";
  const ros::Time next_ = now_ + ros::Duration(0.01);
};

TEST_F(ToolPathTest, TheMotionToThePoseAfterAChangeIsQueuedInBothPlaces) {
  EXPECT_FALSE(push(now_, 0.5, /*static_changes=*/0));
  moveBase(3.0);
  EXPECT_EQ(push(next_, -0.5, /*static_changes=*/1), fromMsg(next_));
  EXPECT_EQ(queued(), std::vector<double>({0.5, -0.5}));
  ASSERT_TRUE(frames_.applyStaticChanges());
  repeat();
  EXPECT_EQ(queued(), std::vector<double>({3.5, 2.5}));
}

TEST_F(ToolPathTest, AtAChangeThatNoPoseComesAfterTheNewestIsQueuedAgain) {
  push(now_, 0.5, /*static_changes=*/0);
  moveBase(3.0);
  EXPECT_GT(path_.endAtNewest(/*static_changes=*/1), fromMsg(now_));
  ASSERT_TRUE(frames_.applyStaticChanges());
  repeat();
  EXPECT_EQ(queued(), std::vector<double>({0.5, 3.5}));
}

TEST_F(ToolPathTest, AChangeBeforeTheFirstPoseRepeatsNothing) {
  moveBase(3.0);
  EXPECT_EQ(path_.endAtNewest(/*static_changes=*/1), sweep_guard_core::Time());
  frames_.applyStaticChanges();
  repeat();
  EXPECT_TRUE(queued().empty());
}

}  // namespace
}  // namespace sweep_guard_ros
