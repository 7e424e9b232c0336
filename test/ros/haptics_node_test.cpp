// The node or the nodelet with its watchdog, as the launch files start them, with a guard that the test plays: a ball above a
// plane whose normal is z. The other one sends to a device that is turned, and tells its own pose. On the wall clock: silence
// has a limit.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/WrenchStamped.h>

#include "child_process.h"
#include "drop_in_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using diagnostic_msgs::DiagnosticArray;
using geometry_msgs::PoseStamped;
using geometry_msgs::WrenchStamped;

constexpr double kDepth = 0.004;
constexpr double kFelt = 0.02;  // [N], with poses at 100 Hz

bool isFelt(const WrenchStamped& wrench) { return std::abs(wrench.wrench.force.x) + wrench.wrench.force.z > kFelt; }
bool isZeroWrench(const WrenchStamped& wrench) { return wrench.wrench == geometry_msgs::Wrench(); }

// The z axis of the device is the x axis of the world.
tf2_msgs::TFMessage turnedFrame() {
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped& transform = message.transforms.emplace_back();
  transform.header.frame_id = "world";
  transform.child_frame_id = "device";
  transform.transform.rotation.y = std::sqrt(0.5);
  transform.transform.rotation.w = std::sqrt(0.5);
  return message;
}

class HapticsNodeTest : public testing::Test {
 protected:
  HapticsNodeTest() {
    spinner_.start();
    frames_.publish(turnedFrame());
    PoseStamped hand = poseIn("device");
    tool_poses_.emplace("/tool_pose");
    tool_poses_->send(poseIn("world"));
    device_poses_.emplace("/device_pose");
    device_poses_->send(hand);
  }
  void TearDown() override { spinner_.stop(); }

  static PoseStamped poseIn(const std::string& frame) {
    PoseStamped pose;
    pose.header.frame_id = frame;
    pose.pose.orientation.w = 1.0;
    return pose;
  }

  // After a second without a force the controller has forgotten what a silence may have cost.
  WrenchStamped press(const Listener<WrenchStamped>& forces) {
    guard_.setGap(0.1);
    ros::Time free = forces.next().header.stamp;
    forces.await("a second without a force", [&](const WrenchStamped& next) {
      if (!isZeroWrench(next)) free = next.header.stamp;
      return next.header.stamp - free > ros::Duration(1.2);
    });
    guard_.setGap(-kDepth);
    return forces.await("a force", isFelt);
  }
  WrenchStamped press() { return press(forces_); }

  // Of a level, or of any.
  void awaitDiagnosis(const std::string& name, std::optional<int> level, const std::string& text) {
    diagnostics_.await(text, [&](const DiagnosticArray& array) {
      for (const auto& status : array.status) {
        if (has(status.name, name) && status.level == level.value_or(status.level) && has(status.message, text))
          return true;
      }
      return false;
    });
  }

  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_{2};
  ros::Publisher frames_ = node_.advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true);
  FakeGuard guard_{"/sweep_guard"};
  std::optional<Stream<PoseStamped>> tool_poses_;
  std::optional<Stream<PoseStamped>> device_poses_;
  Listener<WrenchStamped> forces_{"/servo_cf"};
  Listener<WrenchStamped> turned_forces_{"/turned/servo_cf"};
  Listener<DiagnosticArray> diagnostics_{"/diagnostics"};
};

TEST_F(HapticsNodeTest, APlaneThatTheToolReachesThroughPushesTheDevice) {
  const WrenchStamped wrench = press();
  EXPECT_EQ(wrench.header.frame_id, "world");
  EXPECT_EQ(wrench.wrench.force.x, 0.0);
  EXPECT_GT(wrench.wrench.force.z, kFelt);
  EXPECT_LE(wrench.wrench.force.z, 500.0 * kDepth) << "no more than the stiffness";
  EXPECT_EQ(wrench.wrench.torque, geometry_msgs::Vector3()) << "torque is by choice";
  guard_.setGap(0.01);
  forces_.await("zero in front of the plane", isZeroWrench);
}

TEST_F(HapticsNodeTest, TheForceIsAlongTheAxesOfTheDevice) {
  const WrenchStamped wrench = press(turned_forces_);
  EXPECT_EQ(wrench.header.frame_id, "device");
  EXPECT_LT(wrench.wrench.force.x, -kFelt);
  EXPECT_NEAR(wrench.wrench.force.z, 0.0, 1e-12);
}

TEST_F(HapticsNodeTest, UnknownAndASilentGuardAreZero) {
  press();
  guard_.setLevel(sweep_guard::Warning::UNKNOWN);
  forces_.await("zero", isZeroWrench);
  awaitDiagnosis("force", diagnostic_msgs::DiagnosticStatus::WARN, "zero: the guard's level is UNKNOWN");
  guard_.setLevel(sweep_guard::Warning::CLEAR);
  press();
  guard_.setSilent(true);
  forces_.await("zero", isZeroWrench);
}

TEST_F(HapticsNodeTest, ASilentToolPoseOrDeviceIsZeroAtOnceAndTheForceComesBack) {
  press();
  tool_poses_.reset();
  const ros::Time silent = ros::Time::now();
  const WrenchStamped zero = forces_.await("zero", isZeroWrench);
  EXPECT_LT((zero.header.stamp - silent).toSec(), 0.1) << "70 ms on an idle machine";
  tool_poses_.emplace("/tool_pose");
  tool_poses_->send(poseIn("world"));
  press();
  press(turned_forces_);
  device_poses_.reset();
  turned_forces_.await("zero", isZeroWrench);
  awaitDiagnosis("turned/haptics: force", diagnostic_msgs::DiagnosticStatus::WARN, "zero: no new pose of the device");
  press();  // the other device, which tells no pose
}

TEST_F(HapticsNodeTest, ParametersThatDoNotFitTogetherEndItWithStatusTwo) {
  ChildProcess process(program("haptics_node", {"__name:=refused", "_damping:=2.5", "_device_damping:=2.0"}));
  EXPECT_EQ(process.wait(), 2);
  EXPECT_TRUE(has(process.output(), "device_damping: must be above"));
}

TEST_F(HapticsNodeTest, ASecondPublisherOfTheForceIsAnErrorInTheDiagnostics) {
  const ros::Publisher second = node_.advertise<WrenchStamped>("/haptics/servo_cf", 1);
  awaitDiagnosis("haptics: output", diagnostic_msgs::DiagnosticStatus::ERROR, "past the guard");
}

TEST_F(HapticsNodeTest, WithoutARealTimePriorityItSendsAndSaysWhatToSet) {
  const Listener<WrenchStamped> forces("/refused/servo_cf");
  forces.next();
  awaitDiagnosis("refused/haptics: output", {}, "'USER - rtprio 50' in /etc/security/limits.conf");
}

// The device would repeat the last force.
TEST_F(HapticsNodeTest, TheWatchdogSendsZeroWhenTheNodeDies) {
  press();
  const pid_t pid = pidOf(ros::param::param<std::string>("~process", "/haptics"));
  ASSERT_GT(pid, 0);
  kill(pid, SIGKILL);
  const auto killed = std::chrono::steady_clock::now();
  forces_.await("zero", isZeroWrench);
  EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::milliseconds(200));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(isZeroWrench(forces_.next()));
}

}  // namespace
}  // namespace sweep_guard_ros
