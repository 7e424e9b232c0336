// The demo led by a device with the messages of a SpaceMouse.
#include <gtest/gtest.h>
#include <sensor_msgs/Joy.h>

#include "demo_listener.h"

namespace sweep_guard_ros {
namespace {

using Eigen::Vector3d;
using Poses = DemoListener::Poses;

const ros::Duration kJoyPeriod(0.01);
constexpr double kStickSpeed = 0.15;  // [m/s] of config/operator.yaml

class OperateJoyTest : public ::testing::Test {
 protected:
  // Latched: a message before the connection is not lost.
  OperateJoyTest() : publisher_(node_.advertise<sensor_msgs::Joy>("spacenav/joy", 1, /*latch=*/true)) {}

  void push(const std::vector<float>& axes, int button = 0) {
    sensor_msgs::Joy joy;
    joy.axes = axes;
    joy.buttons = {button};
    publisher_.publish(joy);
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
  DemoListener listener_;
};

// One message and then silence: the tool moves left and stops. The dead zone moves nothing.
TEST_F(OperateJoyTest, TheToolMovesWhileMessagesComeAndStopsWithThem) {
  const Vector3d start = positionOf(listener_.awaitRest(10).back());
  push({0.05F, 1.0F, -0.05F, 0.0F, 0.0F, 0.09F});
  listener_.awaitPoses([&start](const Poses& poses) { return positionOf(poses.back()).y() > start.y() + 0.005; });
  const Poses resting = listener_.awaitRest(50);
  EXPECT_EQ(positionOf(resting.back()).x(), start.x());
  EXPECT_EQ(positionOf(resting.back()).z(), start.z());

  const Poses all = listener_.awaitPoses(0);
  EXPECT_TRUE(isEven(all, kJoyPeriod));
  EXPECT_LE(longestStep(all), kStickSpeed * kJoyPeriod.toSec() + 1e-9);
}

// Slowly, so that a considered warning comes close to the workpiece. The button goes down and up.
TEST_F(OperateJoyTest, AButtonAcknowledgesTheWarning) {
  size_t poses = 0;
  for (int button = 0; !listener_.acknowledged() && poses < 1500; button = 1 - button) {
    push({0.0F, 0.0F, -0.3F, 0.0F, 0.0F, 0.0F}, button);
    poses = listener_.awaitPoses(poses + 5).size();
  }
  EXPECT_TRUE(listener_.acknowledged());
  EXPECT_FALSE(listener_.inContact());
}

// A held device sends messages steadily, here after every fifth pose.
TEST_F(OperateJoyTest, TheToolIsLedIntoTheWorkpiece) {
  size_t poses = 0;
  while (!listener_.inContact() && poses < 1000) {
    push({0.0F, 0.0F, -1.0F, 0.0F, 0.0F, 0.0F});
    poses = listener_.awaitPoses(poses + 5).size();
  }
  EXPECT_TRUE(listener_.inContact());
}

}  // namespace
}  // namespace sweep_guard_ros
