// launch/servo.launch in a namespace, without an argument for that, with a stand-in for MoveIt Servo. On the wall clock:
// silence has a limit.
#include "drop_in_fixture.h"
#include "stand_ins.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::Twist;
using Iteration = FakeServo::Iteration;

constexpr int kNoWarning = 0;

class ServoTest : public DropInTest {
 protected:
  ServoTest() {
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
    await("the whole command", [&](const Iteration& now) { return now.velocity == twist && now.scale == 1.0; });
  }

  void expectStandstill() {
    await("standstill", [](const Iteration& now) { return isZero(now.velocity) && now.scale == 0.0; });
    for (int i = 0; i < 20; ++i) {
      const Iteration now = servo_.iterations().next();
      EXPECT_TRUE(isZero(now.velocity));
      EXPECT_EQ(now.scale, 0.0);
    }
  }

  Stream<geometry_msgs::PoseStamped> poses_{"tool_pose"};
  Stream<geometry_msgs::TwistStamped> commands_{"operator/delta_twist_cmds"};
  FakeServo servo_{"servo_server"};
};

TEST_F(ServoTest, AFreeCommandArrivesUntouchedAndServoChecksNoCollisions) {
  EXPECT_FALSE(servo_.checksCollisions());
  command(kDown);
  awaitVelocity(kDown);
}

TEST_F(ServoTest, ACommandToANearPlaneArrivesLimitedAndARetreatWholeAtFullScale) {
  guard_.setGap(kNear);
  command(kDown);
  const Iteration limited = await("a limited command", [](const Iteration& now) { return isLimited(now.velocity); });
  EXPECT_EQ(limited.scale, 1.0);
  command(kUp);
  awaitVelocity(kUp);
}

// Servo would stay halted if a scale of 0 met another command than zero.
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

TEST_F(ServoTest, StopsByItsOwnTimeoutWhenTheMotionGuardDies) {
  const auto killed = killMotionGuard();
  await("standstill", [](const Iteration& now) { return isZero(now.velocity); });
  EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::milliseconds(200));
}

}  // namespace
}  // namespace sweep_guard_ros
