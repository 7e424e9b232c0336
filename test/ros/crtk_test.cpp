// launch/crtk.launch in a namespace, without an argument for that, with a stand-in for an arm of the dVRK. On the wall
// clock: silence has a limit.
#include "drop_in_fixture.h"
#include "stand_ins.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::PoseStamped;

geometry_msgs::Pose armPose(double x, double z) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.position.z = z;
  pose.orientation.w = 1.0;
  return pose;
}

class CrtkTest : public DropInTest {
 protected:
  CrtkTest() { moveTo(0.001, 0.001); }

  void command(double x, double z) {
    PoseStamped message;
    message.header.frame_id = "world";
    message.pose = armPose(x, z);
    commands_.send(message);
  }

  void moveTo(double x, double z) {
    command(x, z);
    arm_.commands().await("the commanded pose", [&](const PoseStamped& next) { return next.pose == armPose(x, z); });
  }

  // The arm is commanded elsewhere meanwhile.
  void expectTheLastPoseAgain() {
    command(0.1, 0.1);
    const PoseStamped last = arm_.commands().await("the last pose again", [this](const PoseStamped& next) {
      const bool again = before_ == next.pose;
      before_ = next.pose;
      return again;
    });
    for (int i = 0; i < 20; ++i) EXPECT_EQ(arm_.commands().next().pose, last.pose);
  }

  FakeArm arm_{"PSM1", armPose(0.0, 0.0)};
  Stream<PoseStamped> commands_{"operator/servo_cp"};
  geometry_msgs::Pose before_;
};

TEST_F(CrtkTest, AFreePoseArrivesUntouched) { moveTo(-0.001, -0.001); }

TEST_F(CrtkTest, APoseBehindANearPlaneIsNotReachedAndARetreatIsWhole) {
  guard_.setGap(kNear);
  command(0.001, -0.1);
  double lowest = 0.0;
  for (int i = 0; i < 100; ++i) lowest = std::min(lowest, arm_.commands().next().pose.position.z);
  EXPECT_LT(lowest, 0.0);
  EXPECT_GT(lowest, -kNear);
  moveTo(0.001, 0.0);
}

TEST_F(CrtkTest, SendsTheLastPoseAgainWhileTheGuardIsUnknownOrSilent) {
  guard_.setLevel(sweep_guard::Warning::UNKNOWN);
  expectTheLastPoseAgain();
  guard_.setLevel(sweep_guard::Warning::CLEAR);
  moveTo(0.1, 0.1);
  guard_.setSilent(true);
  command(0.0, 0.0);
  expectTheLastPoseAgain();
}

}  // namespace
}  // namespace sweep_guard_ros
