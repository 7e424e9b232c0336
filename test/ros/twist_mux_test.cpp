// launch/twist_mux.launch, with a stand-in for twist_mux. On the wall clock: silence has a limit.
#include "drop_in_fixture.h"
#include "stand_ins.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::Twist;

class TwistMuxTest : public DropInTest {
 protected:
  TwistMuxTest() {
    publishFrames({{"world", "base_link"}, {"base_link", "tool"}});
    poses_.send(poseAtOrigin());
    commands_.send(kUp);
    awaitCommand(kUp);
  }

  void awaitCommand(const Twist& twist) {
    robot_.await("the whole command", [&](const Twist& next) { return next == twist; });
  }

  void expectLockAndStandstill() {
    robot_.await("zero", [](const Twist& next) { return isZero(next); });
    mux_.locked().await("the lock", [](bool locked) { return locked; });
  }

  Stream<geometry_msgs::PoseStamped> poses_{"tool_pose"};
  Stream<Twist> commands_{"nav_vel"};
  FakeTwistMux mux_{"twist_mux"};
  Listener<Twist> robot_{"cmd_vel"};
};

TEST_F(TwistMuxTest, AFreeCommandArrivesUntouched) {
  commands_.send(kDown);
  awaitCommand(kDown);
}

TEST_F(TwistMuxTest, ACommandToANearPlaneArrivesLimitedAndARetreatWholeWithoutALock) {
  guard_.setGap(kNear);
  commands_.send(kDown);
  robot_.await("a limited command", isLimited);
  EXPECT_FALSE(mux_.locked().next());
  commands_.send(kUp);
  awaitCommand(kUp);
}

TEST_F(TwistMuxTest, LocksTheMuxAndSendsZeroWhileTheGuardIsUnknownOrSilent) {
  guard_.setLevel(sweep_guard::Warning::UNKNOWN);
  expectLockAndStandstill();
  guard_.setLevel(sweep_guard::Warning::CLEAR);
  awaitCommand(kUp);
  guard_.setSilent(true);
  expectLockAndStandstill();
  guard_.setSilent(false);
  awaitCommand(kUp);
}

TEST_F(TwistMuxTest, IsLockedByTheTimeoutOfTheLockWhenTheMotionGuardDies) {
  EXPECT_FALSE(mux_.locked().next());
  const auto killed = killMotionGuard();
  mux_.locked().await("the lock", [](bool locked) { return locked; });
  EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::milliseconds(300));
}

}  // namespace
}  // namespace sweep_guard_ros
