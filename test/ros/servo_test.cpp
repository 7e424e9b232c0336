// launch/servo.launch in a namespace, without an argument for that, with a stand-in for MoveIt Servo. On the wall clock:
// silence has a limit.
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include "drop_in_fixture.h"
#include "stand_ins.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::Twist;
using trajectory_msgs::JointTrajectory;
using Iteration = FakeServo::Iteration;

constexpr int kNoWarning = 0;

class ServoTest : public DropInTest {
 protected:
  ServoTest() {
    sensor_msgs::JointState state;
    state.name = {"shoulder", "elbow", "jaw"};
    state.position.assign(3, 0.0);
    joint_states_.send(state);
    poses_.send(poseAtOrigin());
    command(kUp);
    awaitVelocity(kUp);
  }

  void command(const Twist& twist) {
    geometry_msgs::TwistStamped message;
    message.header.frame_id = "world";
    message.twist = twist;
    commands_.send(message);
  }

  Iteration await(const std::string& what, const std::function<bool(const Iteration&)>& fits) const {
    return servo_.iterations().await(what, fits);
  }

  void awaitVelocity(const Twist& twist) const {
    await("the whole command", [&](const Iteration& now) { return now.velocity == twist; });
  }

  void expectStandstill() {
    await("standstill", [](const Iteration& now) { return isZero(now.velocity); });
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(isZero(servo_.iterations().next().velocity));
  }

  static double shoulderSpeed(const JointTrajectory& sent) { return sent.points.at(0).velocities.at(0); }
  void awaitShoulder(double speed) const {
    controller_.await("a speed of the shoulder", [=](const auto& sent) { return shoulderSpeed(sent) == speed; });
  }

  Stream<geometry_msgs::PoseStamped> poses_{"tool_pose"};
  Stream<geometry_msgs::TwistStamped> commands_{"operator/delta_twist_cmds"};
  Stream<sensor_msgs::JointState> joint_states_{"joint_states"};
  FakeServo servo_{"servo_server"};
  FakeGuard arm_guard_{
      "arm_guard", {"base", "fore", {0.2, 0.0, 0.0}, {0.5, 0.0, 0.0}, {"shoulder", "elbow", "jaw"}, {0.0, 0.0, 0.0}}};
  Listener<JointTrajectory> controller_{"joint_group_velocity_controller/command"};
};

TEST_F(ServoTest, WithoutArgumentsTheLagIsThatOfTheConfigurationAndBeforeServoThatOfARobotNotZero) {
  EXPECT_DOUBLE_EQ(ros::param::param("links_motion_guard/lag/dead_time", 0.0), 0.01);
  EXPECT_DOUBLE_EQ(ros::param::param("links_motion_guard/lag/time_constant", 0.0), 0.04);
  EXPECT_DOUBLE_EQ(ros::param::param("motion_guard/lag/dead_time", 0.0), 0.028);
  EXPECT_DOUBLE_EQ(ros::param::param("motion_guard/lag/time_constant", 0.0), 0.038);
}

// Both are Servo's own, which looks for self-collisions with them.
TEST_F(ServoTest, AFreeCommandArrivesUntouchedAndServosScaleAndChecksAreLeftAlone) {
  EXPECT_FALSE(servo_.hearsAScale());
  EXPECT_FALSE(ros::param::has("servo_server/check_collisions"));
  command(kDown);
  awaitVelocity(kDown);
}

TEST_F(ServoTest, ACommandToANearPlaneArrivesLimitedAndARetreatWhole) {
  guard_.setGap(kNear);
  command(kDown);
  await("a limited command", [](const Iteration& now) { return isLimited(now.velocity); });
  command(kUp);
  awaitVelocity(kUp);
}

TEST_F(ServoTest, StopsWhileTheGuardIsUnknownOrSilentAndGoesOnWithoutAReset) {
  for (int i = 0; i < 5; ++i) {
    guard_.setLevel(sweep_guard::Warning::UNKNOWN);
    expectStandstill();
    guard_.setLevel(sweep_guard::Warning::CLEAR);
    awaitVelocity(kUp);
    guard_.setSilent(true);
    expectStandstill();
    guard_.setSilent(false);
    awaitVelocity(kUp);
  }
  EXPECT_EQ(servo_.iterations().next().status, kNoWarning);
}

// The tip is free, a link is not.
TEST_F(ServoTest, BehindServoTheJointsAreLimitedBeforeALinkAndARetreatIsWhole) {
  arm_guard_.setGap(kNear);
  command(kDown);
  awaitVelocity(kDown);
  const double whole = -kDown.linear.z / FakeServo::kReach;
  controller_.await("a part of the speed",
                    [=](const auto& sent) { return shoulderSpeed(sent) > 0.0 && shoulderSpeed(sent) < 0.9 * whole; });
  command(kUp);
  awaitShoulder(-kUp.linear.z / FakeServo::kReach);
}

TEST_F(ServoTest, BehindServoTheJointsStopWhileTheGuardOfTheLinksIsUnknown) {
  awaitShoulder(-kUp.linear.z / FakeServo::kReach);
  arm_guard_.setLevel(sweep_guard::Warning::UNKNOWN);
  awaitShoulder(0.0);
  awaitVelocity(kUp);
  arm_guard_.setLevel(sweep_guard::Warning::CLEAR);
  awaitShoulder(-kUp.linear.z / FakeServo::kReach);
}

TEST_F(ServoTest, StopsByItsOwnTimeoutWhenTheMotionGuardDies) {
  const auto killed = killMotionGuard();
  await("standstill", [](const Iteration& now) { return isZero(now.velocity); });
  EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::milliseconds(200));
}

}  // namespace
}  // namespace sweep_guard_ros
