// Frames in one process with their publisher.
#include "ros/input/resting_pose.h"

#include "base_and_arm.h"

namespace sweep_guard_ros {
namespace {

using std::chrono::milliseconds;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::SteadyTime;

class RestingPoseTest : public BaseAndArm {
 protected:
  explicit RestingPoseTest(const std::string& tool_frame = "arm") : tool_(ofTool(tool_frame)) {
    frames_.start(supervisor_);
  }
  static Parameters ofTool(const std::string& tool_frame) {
    Parameters parameters = patient();
    parameters.tool_frame = tool_frame;
    parameters.guard.cycle = milliseconds(100);
    return parameters;
  }
  void restArm() { static_transforms_.publish(transform("base", "arm", ros::Time(), 0.5)); }
  bool isDue(int stamp_ms, int steady_ms) {
    return resting_.isDue({sweep_guard_core::Time(milliseconds(stamp_ms)), SteadyTime(milliseconds(steady_ms))});
  }

  const Parameters tool_;
  const LiveParameters live_tool_{tool_};
  RestingPose resting_{live_tool_, frames_};
};

// Also of a tool that moves or is not known, for which nothing is found: the answer makes no difference.
TEST_F(RestingPoseTest, IsDueAtTheLeastRateByEitherClock) {
  EXPECT_FALSE(isDue(0, 5000)) << "time has not begun";
  EXPECT_TRUE(isDue(5000, 5000));
  int asked = 0;
  for (int ms = 5010; ms <= 6000; ms += 10) asked += isDue(ms, ms) ? 1 : 0;
  EXPECT_EQ(asked, 10);
  EXPECT_TRUE(isDue(6200, 6010)) << "a fast replay";
  EXPECT_TRUE(isDue(6200, 6110)) << "stamps stand still";
  EXPECT_FALSE(isDue(6210, 6120));
  EXPECT_TRUE(isDue(1000, 6130)) << "stamps went back";
  EXPECT_FALSE(isDue(1010, 6140));
}

TEST_F(RestingPoseTest, IsDueTwiceInATimeoutThatIsShorterThanTheCycle) {
  for (const int timeout_ms : {100, 40, 20}) {
    Parameters parameters = tool_;
    parameters.limits.pose_timeout = milliseconds(timeout_ms);
    const LiveParameters live(parameters);
    RestingPose resting(live, frames_);
    int asked = 0;
    for (int ms = 5000; ms < 6000; ++ms) {
      asked += resting.isDue({sweep_guard_core::Time(milliseconds(ms)), SteadyTime(milliseconds(ms))}) ? 1 : 0;
    }
    EXPECT_EQ(asked, 2000 / timeout_ms);
  }
}

TEST_F(RestingPoseTest, RestsWhileNoTransformMovesIt) {
  const sweep_guard_core::Time stamp = fromMsg(now_);
  EXPECT_FALSE(resting_.rests(stamp)) << "is not known";
  restArm();
  placeBase(1.0);
  awaitFrame("arm");
  EXPECT_TRUE(resting_.rests(stamp));
  transforms_.publish(transform(parameters_.fixed_frame, "base", now_, 2.0));
  awaitArm(now_);
  EXPECT_FALSE(resting_.rests(stamp));
}

// As those of a static transform that is published ahead by its period.
TEST_F(RestingPoseTest, RestsWhereTransformsThatLieAheadDoNotMoveIt) {
  const DrivenClock clock(now_);
  placeBase(1.0);
  awaitFrame("base");
  moveArm(now_);
  awaitArm(now_);
  EXPECT_TRUE(resting_.moves(fromMsg(now_)));
  ros::Time newest;
  const auto moveAhead = [&](double ahead) {
    newest = now_ + ros::Duration(ahead);
    moveArm(newest);
    awaitArm(newest);
    return resting_.moves(fromMsg(newest));
  };
  for (const double ahead : {0.7, 0.8, 0.95}) {
    EXPECT_FALSE(moveAhead(ahead)) << ahead;
    EXPECT_TRUE(resting_.rests(fromMsg(newest - ros::Duration(0.1)))) << ahead;
    EXPECT_FALSE(resting_.rests(fromMsg(newest + ros::Duration(0.001)))) << ahead;
  }
  transforms_.publish(transform("base", "arm", newest + ros::Duration(0.1), 0.001));
  awaitArm(newest + ros::Duration(0.1));
  EXPECT_TRUE(resting_.moves(fromMsg(newest + ros::Duration(0.1))));
  EXPECT_FALSE(resting_.rests(fromMsg(newest)));
}

TEST_F(RestingPoseTest, TransformsThatLieFarAheadAreNoRest) {
  const DrivenClock clock(now_);
  placeBase(1.0);
  awaitFrame("base");
  moveArm(now_);
  for (const double ahead : {3.0, 5.0, 8.0}) {
    const ros::Time newest = now_ + ros::Duration(ahead);
    moveArm(newest);
    awaitArm(newest);
    EXPECT_TRUE(resting_.moves(fromMsg(newest))) << ahead;
    EXPECT_FALSE(resting_.rests(fromMsg(now_ + ros::Duration(0.1)))) << ahead;
  }
}

TEST_F(RestingPoseTest, TransformsWithoutStampsAreNoRest) {
  placeBase(1.0);
  moveArm(ros::Time());
  awaitFrame("arm");
  EXPECT_THROW(resting_.rests(fromMsg(now_)), InvalidInput);
}

class FixedToolTest : public RestingPoseTest {
 protected:
  FixedToolTest() : RestingPoseTest("/" + patient().fixed_frame) {}
};

TEST_F(FixedToolTest, AToolThatIsTheFixedFrameIsNoRest) { EXPECT_THROW(resting_.rests(fromMsg(now_)), InvalidInput); }

}  // namespace
}  // namespace sweep_guard_ros
