// launch/velocity_controller.launch, with a stand-in for the UR driver's controller. On the wall clock: silence has a limit.
#include "drop_in_fixture.h"
#include "stand_ins.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::Twist;

class VelocityControllerTest : public DropInTest {
 protected:
  VelocityControllerTest() {
    publishFrames({{"world", "base"}, {"tool", "tool0_controller"}});
    poses_.send(poseAtOrigin());
    commands_.send(kUp);
    awaitCommand(kUp);
  }

  void awaitCommand(const Twist& twist) {
    controller_.commands().await("the whole command", [&](const Twist& next) { return next == twist; });
  }

  void expectStandstill() {
    controller_.commands().await("zero", isZero);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(isZero(controller_.commands().next()));
  }

  Stream<geometry_msgs::PoseStamped> poses_{"tool_pose"};
  Stream<Twist> commands_{"operator/twist"};
  FakeVelocityController controller_{"twist_controller"};
};

// The time-out of zero_on_silence is half of the period.
TEST_F(DropInTest, ASlowOperatorsRobotMovesAllOfTheTime) {
  publishFrames({{"world", "base"}, {"tool", "tool0_controller"}});
  Stream<geometry_msgs::PoseStamped> poses("tool_pose");
  poses.send(poseAtOrigin());
  Stream<Twist> commands("operator/twist", std::chrono::milliseconds(200));
  const FakeVelocityController controller("twist_controller");
  for (const Twist& command : {kUp, kDown, velocity(0.1, 0.1)}) {
    commands.send(command);
    controller.commands().await("the whole command", [&](const Twist& next) { return next == command; });
    int zeros = 0;
    for (int i = 0; i < 15; ++i) zeros += isZero(controller.commands().next()) ? 1 : 0;
    EXPECT_LE(zeros, 4) << "they are four of five where zero is sent in between";
  }
}

TEST_F(VelocityControllerTest, AFreeCommandArrivesUntouched) {
  commands_.send(kDown);
  awaitCommand(kDown);
}

TEST_F(VelocityControllerTest, ACommandToANearPlaneArrivesLimitedAndARetreatWhole) {
  guard_.setGap(kNear);
  commands_.send(kDown);
  controller_.commands().await("a limited command", isLimited);
  commands_.send(kUp);
  awaitCommand(kUp);
}

TEST_F(VelocityControllerTest, StopsWhileTheGuardIsUnknownOrSilent) {
  guard_.setLevel(sweep_guard::Warning::UNKNOWN);
  expectStandstill();
  guard_.setLevel(sweep_guard::Warning::CLEAR);
  awaitCommand(kUp);
  guard_.setSilent(true);
  expectStandstill();
  guard_.setSilent(false);
  awaitCommand(kUp);
}

TEST_F(VelocityControllerTest, IsSentZeroWithin200MillisecondsWhenTheMotionGuardDies) {
  const auto killed = killMotionGuard();
  expectStandstill();
  EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::milliseconds(400)) << "with ten zeros at 50 Hz";
}

}  // namespace
}  // namespace sweep_guard_ros
