// The pose by which motions are limited, of a tool that tf places.
#include "ros/motion/tool_pose_input.h"

#include "base_and_arm.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

class ToolPoseInputTest : public BaseAndArm {
 protected:
  ToolPoseInputTest() { frames_.start(supervisor_); }

  static PoseSource inTf(const std::string& fixed_frame, const std::string& frame) {
    PoseSource source;
    source.source = ToolSource::kTf;
    source.fixed_frame = fixed_frame;
    source.frame = frame;
    source.silence = std::chrono::seconds(1);
    return source;
  }
  void restArm() { static_transforms_.publish(transform("base", "arm", ros::Time(), 0.5)); }
  static std::string awaitStandstill(const ToolPoseInput& input) {
    await("a standstill", [&] { return !input.standstill().empty(); });
    return input.standstill();
  }
  static Eigen::Vector3d awaitPose(const ToolPoseInput& input, ros::Time stamp) {
    auto pose = input.newest();
    await("a pose", [&] {
      pose = input.newest();
      return pose && pose->timestamps.stamp == fromMsg(stamp);
    });
    return pose->X_WT.translation();
  }

  const std::string& world_ = parameters_.fixed_frame;
};

TEST_F(ToolPoseInputTest, IsNoneWhereNoTransformShowsThatTheFrameMoves) {
  const ToolPoseInput base(node_, inTf(world_, "base"), frames_);
  const ToolPoseInput arm(node_, inTf(world_, "arm"), frames_);
  const ToolPoseInput world(node_, inTf(world_, "/" + world_), frames_);
  EXPECT_EQ(base.standstill(), "");
  placeBase(1.0);
  moveArm(ros::Time());
  EXPECT_EQ(awaitStandstill(base),
            "only static transforms place 'base' in '" + world_ +
                "', and none shows how it moves: publish those of the robot on /tf, or set tool_frame to a frame that "
                "moves");
  EXPECT_EQ(awaitStandstill(arm), "the transforms to 'arm' have the stamp 0: stamp each");
  EXPECT_EQ(awaitStandstill(world), "tool_frame is fixed_frame, in which it never moves");
  for (const ToolPoseInput* input : {&base, &arm, &world}) {
    EXPECT_FALSE(input->newest());
    EXPECT_EQ(input->record().summary().last_error, input->standstill());
    EXPECT_EQ(input->record().summary().refused, 1U);
  }
}

TEST_F(ToolPoseInputTest, BeginsWithTheFirstTransformThatMoves) {
  const ToolPoseInput arm(node_, inTf(world_, "arm"), frames_);
  const ToolPoseInput on_base(node_, inTf("base", "arm"), frames_);
  placeBase(1.0);
  restArm();
  awaitStandstill(arm);
  awaitStandstill(on_base);
  transforms_.publish(transform(world_, "base", now_, 2.0));
  EXPECT_EQ(awaitPose(arm, now_).z(), 2.5);
  EXPECT_EQ(arm.standstill(), "");
  EXPECT_FALSE(on_base.newest());  // which moves as the base does
  EXPECT_NE(on_base.standstill(), "");
  const ros::Time next = now_ + ros::Duration(0.01);
  moveArm(next);
  EXPECT_EQ(awaitPose(on_base, next).z(), 0.0);
  EXPECT_EQ(on_base.standstill(), "");
}

}  // namespace
}  // namespace sweep_guard_ros
