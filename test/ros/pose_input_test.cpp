// The input of poses in one process with their publisher, where a published message is queued at once.
#include "ros/input/pose_input.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <boost/make_shared.hpp>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

boost::shared_ptr<geometry_msgs::PoseStamped> poseIn(const std::string& frame, ros::Time stamp) {
  auto pose = boost::make_shared<geometry_msgs::PoseStamped>();
  pose->header.frame_id = frame;
  pose->header.stamp = stamp;
  pose->pose.orientation.w = 1.0;
  return pose;
}

// 20 s at 1 kHz are published before the first pose is taken from the queue.
TEST(PoseInputTest, NoPoseOfALongBacklogIsLost) {
  constexpr int kPoses = 20000;
  ros::NodeHandle node;
  const ros::Time end = ros::Time::now();
  const Parameters parameters = loadParameters(ros::NodeHandle("~"));
  Frames frames(node, parameters.max_message_size, [](const std::string&, const std::string&) {});
  sweep_guard_core::WarningMonitor monitor(parameters.limits);
  const sweep_guard_core::WorkpieceStore workpieces;
  WorkQueue queue;
  sweep_guard_core::FrameMotionStore frame_motions;
  Supervisor supervisor(Process::kShared);
  const LiveParameters live(parameters);
  PoseInput input(node, live, {frames, workpieces, monitor, queue, frame_motions});
  const ros::Publisher publisher = node.advertise<geometry_msgs::PoseStamped>("tool_pose", 1);
  ASSERT_EQ(publisher.getNumSubscribers(), 1U);
  input.start(supervisor);
  for (int i = 1; i <= kPoses; ++i) {
    publisher.publish(poseIn(parameters.fixed_frame, end - ros::Duration(0.001 * (kPoses - i))));
  }
  size_t poses = 0;
  WorkQueue::Work work;
  do {
    queue.take(work);
    poses += work.poses.size();
  } while (work.poses.back().pose.stamp != fromMsg(end));
  EXPECT_EQ(poses, static_cast<size_t>(kPoses));
}

}  // namespace
}  // namespace sweep_guard_ros
