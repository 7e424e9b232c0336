// What a motion guard that runs still allocates, from a command to what is let through of it. All is one process, as
// nodelets are. A test plays the guard.
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <set>
#include <string>
#include <vector>

#include "ros/allowed_allocations.h"
#include "ros/motion/motion_guard_node.h"
#include "ros/motion_guard_fixture.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::TwistStamped;

constexpr int kWarmUpCommands = 500;
constexpr int kCountedCommands = 1000;
const std::set<std::string> kCommandThreads = {"commands"};

// Sends a command, and waits for what the motion guard makes of it.
class Commander {
 public:
  Commander() {
    ros::NodeHandle node;
    node.setCallbackQueue(&queue_);
    publisher_ = node.advertise<TwistStamped>("command", 1);
    subscriber_ = node.subscribe<TwistStamped>("guarded_command", 1,
                                               [this](const TwistStamped::ConstPtr& msg) { guarded_ = msg; });
  }

  TwistStamped::ConstPtr send(double x) {
    const auto msg = boost::make_shared<TwistStamped>();
    msg->header.frame_id = "world";
    msg->header.stamp = ros::Time::now();
    msg->twist.linear.x = x;
    guarded_.reset();
    publisher_.publish(msg);
    while (ros::ok() && !guarded_) queue_.callOne(ros::WallDuration(1.0));
    return guarded_;
  }

  void repeat(int count, double x) {
    for (int i = 0; i < count; ++i) send(x);
  }

 private:
  TwistStamped::ConstPtr guarded_;
  ros::CallbackQueue queue_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

class MotionAllocationTest : public testing::Test {
 protected:
  MotionAllocationTest() : motion_guard_(ros::NodeHandle(), ros::NodeHandle("~"), Process::kShared) {
    spinner_.start();
    motion_guard_.start();
  }

  void awaitSpeed(double commanded, double from, double to) {
    double sent = 0.0;
    while (ros::ok() && !(sent >= from && sent <= to)) sent = commander_.send(commanded)->twist.linear.x;
  }

  ros::AsyncSpinner spinner_{1};
  MotionGuardNode motion_guard_;
  MotionWorld world_;
  Commander commander_;
};

TEST_F(MotionAllocationTest, OfACommandThatIsPassedOnOnlyThePublicationAllocates) {
  awaitSpeed(0.1, 0.1, 0.1);
  commander_.repeat(kWarmUpCommands, 0.1);
  const sweep_guard_core::AllocationsOfAllThreads made;
  commander_.repeat(kCountedCommands, 0.1);
  expectAllocations(made, kCommandThreads,
                    {{"ros::Publisher::publish", false, 2.2, "roscpp hands the message to its subscriber"}},
                    kCountedCommands);
}

TEST_F(MotionAllocationTest, OfACommandThatIsSlowedDownOnlyItsCopyAndTheStatusAllocate) {
  world_.change([](auto& state) { state.X_WT = Eigen::Translation3d(0.02, 0.0, 0.0); });
  awaitSpeed(-0.5, -0.3, -0.01);
  commander_.repeat(kWarmUpCommands, -0.5);
  const sweep_guard_core::AllocationsOfAllThreads made;
  commander_.repeat(kCountedCommands, -0.5);
  expectAllocations(
      made, kCommandThreads,
      {{"ros::Publisher::publish", false, 4.2, "roscpp: the command, and both forms of the status"},
       {"boost::make_shared", true, 1.1, "nodelets keep what is published: each command is its own message"},
       {"statusOf", true, 4.1, "names and text, which change with the gap"}},
      kCountedCommands);
}

}  // namespace
}  // namespace sweep_guard_ros
