#include "ros/input/late_poses.h"

#include "base_and_arm.h"

namespace sweep_guard_ros {
namespace {

class LatePosesTest : public BaseAndArm {
 protected:
  LatePosesTest() {
    frames_.start(supervisor_);
    placeBase(3.0);
    moveArm(now_);
    awaitFrame("arm");
  }
  std::optional<sweep_guard_core::QueuedPose> locate(const std::string& frame, ros::Time stamp) {
    return late_.locate({{fromMsg(stamp), std::chrono::steady_clock::now()}, frame, Eigen::Isometry3d::Identity()});
  }

  LatePoses late_{live_, frames_};
  const ros::Time next_ = now_ + ros::Duration(0.01);
};

TEST_F(LatePosesTest, APoseWhoseTransformIsThereDoesNotWait) {
  const auto located = locate("arm", now_);
  ASSERT_TRUE(located);
  EXPECT_EQ(located->pose.X_WT.translation().z(), 3.0);
  EXPECT_EQ(late_.newest(), fromMsg(now_));
  EXPECT_TRUE(late_.empty());
}

TEST_F(LatePosesTest, APoseThatWaitsHoldsUpThoseAfterIt) {
  const ros::Time last = next_ + ros::Duration(0.01);
  EXPECT_FALSE(locate("arm", next_));
  EXPECT_TRUE(late_.hasBegunToWait());
  EXPECT_FALSE(locate("base", last));
  EXPECT_FALSE(late_.locateNext());
  EXPECT_EQ(late_.newest(), fromMsg(last));
  moveArm(next_);
  awaitArm(next_);
  EXPECT_EQ(late_.locateNext().value().pose.stamp, fromMsg(next_));
  EXPECT_EQ(late_.frame(), "arm");
  EXPECT_EQ(late_.locateNext().value().pose.stamp, fromMsg(last));
  EXPECT_TRUE(late_.empty());
}

TEST_F(LatePosesTest, APoseInAFrameThatNobodyPublishesIsLeftOut) {
  EXPECT_THROW(locate("nowhere", now_), FrameError);
  EXPECT_TRUE(late_.empty());
  EXPECT_FALSE(late_.newest());
}

}  // namespace
}  // namespace sweep_guard_ros
