// What a cycle of haptics allocates while the surfaces push the device, with torque, damping, cue and a device frame that moves in
// tf. The watchdog is another process, the guard is played by this one.
#include <geometry_msgs/WrenchStamped.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include "ros/allowed_allocations.h"
#include "ros/drop_in_fixture.h"
#include "ros/haptics/haptics_node.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::WrenchStamped;

const ros::Duration kWarmUpTime(0.5);
const ros::Duration kCountedTime(1.0);
constexpr double kCycles = 1000.0;  // in that time
const std::set<std::string> kForceThreads = {"forces"};

tf2_msgs::TFMessage deviceFrame() {
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped& transform = message.transforms.emplace_back();
  transform.header.frame_id = "world";
  transform.header.stamp = ros::Time::now();
  transform.child_frame_id = "device";
  transform.transform.rotation.w = 1.0;
  return message;
}

class HapticsAllocationTest : public testing::Test {
 protected:
  HapticsAllocationTest() : haptics_(ros::NodeHandle(), ros::NodeHandle("~"), Process::kShared) {
    spinner_.start();
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = "world";
    pose.pose.orientation.w = 1.0;
    poses_.send(pose);
    haptics_.start();
  }

  ros::Time awaitForce() {
    return passed_.await("a force", [](const WrenchStamped& wrench) { return wrench.wrench.force.z > 0.0; })
        .header.stamp;
  }
  // The controller may have taken the force back meanwhile, where the machine is busy.
  ros::Time awaitCycleAfter(const ros::Time& time) {
    return passed_.await("a cycle", [&](const WrenchStamped& wrench) { return wrench.header.stamp > time; })
        .header.stamp;
  }

  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_{2};
  ros::Publisher frames_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 1);
  const Repeater frames_repeater_{std::chrono::milliseconds(10), [this] { frames_.publish(deviceFrame()); }};
  FakeGuard guard_{"/fake"};
  Stream<geometry_msgs::PoseStamped> poses_{"tool_pose"};
  Listener<WrenchStamped> passed_{"passed_cf"};
  HapticsNode haptics_;
};

TEST_F(HapticsAllocationTest, OfACycleOnlyThePublicationAllocates) {
  guard_.setGap(-0.004);
  const ros::Time begin = awaitCycleAfter(awaitForce() + kWarmUpTime);
  const sweep_guard_core::AllocationsOfAllThreads made;
  awaitCycleAfter(begin + kCountedTime);
  expectAllocations(made, kForceThreads,
                    {{"ros::Publisher::publish", false, 4.2, "roscpp makes bytes of the message, and queues them"}},
                    kCycles, /*growth=*/0.0);
}

}  // namespace
}  // namespace sweep_guard_ros
