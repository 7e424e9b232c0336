// The input of poses by itself, in one process with their publisher: a message waits as soon as it is published.
#include "ros/input/pose_input.h"

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <boost/make_shared.hpp>
#include <future>
#include <vector>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

boost::shared_ptr<geometry_msgs::PoseStamped> poseAt(const std::string& frame, ros::Time stamp) {
  auto pose = boost::make_shared<geometry_msgs::PoseStamped>();
  pose->header.frame_id = frame;
  pose->header.stamp = stamp;
  pose->pose.orientation.w = 1.0;
  return pose;
}

// 20 s at 1 kHz wait for the first pose to be swept.
TEST(PoseInputTest, NoPoseOfALongBacklogIsLost) {
  constexpr int kPoses = 20000;
  ros::NodeHandle node;
  const ros::Time end = ros::Time::now();
  std::promise<void> published;
  std::promise<void> last_came;
  std::vector<sweep_guard_core::Time> came;
  const auto sweep = [&, all_wait = published.get_future().share()](const QueuedPose& placed) {
    all_wait.wait();
    came.push_back(placed.pose.stamp);
    if (placed.pose.stamp == fromMsg(end)) last_came.set_value();
  };

  const Parameters parameters = loadParameters(ros::NodeHandle("~"));
  Frames frames;
  sweep_guard_core::WarningMonitor monitor(parameters.limits);
  const WorkpieceStore workpieces(parameters.max_triangles, monitor);
  PoseInput input(node, parameters, frames, workpieces, monitor, sweep);
  const ros::Publisher publisher = node.advertise<geometry_msgs::PoseStamped>("tool_pose", 1);
  ASSERT_EQ(publisher.getNumSubscribers(), 1U);
  input.start();
  for (int i = 1; i <= kPoses; ++i) {
    publisher.publish(poseAt(parameters.fixed_frame, end - ros::Duration(0.001 * (kPoses - i))));
  }
  published.set_value();
  last_came.get_future().wait();
  EXPECT_EQ(came.size(), static_cast<size_t>(kPoses));
}

}  // namespace
}  // namespace sweep_guard_ros
