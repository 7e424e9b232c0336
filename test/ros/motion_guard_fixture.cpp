#include "ros/motion_guard_fixture.h"

#include <geometry_msgs/PoseStamped.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/transform_message.h"

namespace sweep_guard_ros {
namespace {

sweep_guard::ToolBalls needle() {
  sweep_guard::ToolBalls tool;
  tool.header.frame_id = "tool";
  tool.header.stamp = ros::Time::now();
  tool.tool = "tool";
  tool.revision = 1;
  tool.pieces.resize(1);
  tool.pieces[0].link = "needle";
  tool.pieces[0].balls.resize(2);
  tool.pieces[0].balls[1].center.x = 0.1;
  return tool;
}

sweep_guard::Proximity wall(const ros::Time& now, const Eigen::Isometry3d& X_WT, double x) {
  sweep_guard::Proximity planes;
  planes.header.stamp = now;
  planes.header.frame_id = "world";
  planes.tool = "tool";
  planes.tool_pose = toMsg(X_WT);
  planes.tool_revision = 1;
  planes.valid_until = now + ros::Duration(2.0);
  planes.valid = true;
  planes.uncovered_distance = std::numeric_limits<double>::infinity();
  planes.planes.resize(1);
  planes.planes[0].tool_link = "needle";
  planes.planes[0].mesh_id = "wall";
  planes.planes[0].triangle = 7;
  planes.planes[0].normal.x = 1.0;
  planes.planes[0].point.x = x;
  return planes;
}

tf2_msgs::TFMessage frames() {
  tf2_msgs::TFMessage frames;
  const Eigen::Isometry3d quarter_turn(Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()));
  frames.transforms = {transformMsg("tool", "tip", Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.0, 0.0))),
                       transformMsg("world", "turned", quarter_turn)};
  return frames;
}

// The tool hangs on a joint, whose transform is a message of its own.
tf2_msgs::TFMessage joined(const std::string& parent, const std::string& child, const Eigen::Isometry3d& X_PC,
                           const ros::Time& now) {
  tf2_msgs::TFMessage frames;
  frames.transforms = {transformMsg(parent, child, X_PC, now)};
  return frames;
}

}  // namespace

MotionWorld::MotionWorld()
    : warning_(node_.advertise<sweep_guard::Warning>("/fake/warning", 10)),
      planes_(node_.advertise<sweep_guard::Proximity>("/fake/proximity", 10)),
      tool_(node_.advertise<sweep_guard::ToolBalls>("/fake/tool_balls", 1, /*latch=*/true)),
      pose_(node_.advertise<geometry_msgs::PoseStamped>("tool_pose", 10)),
      joints_(node_.advertise<tf2_msgs::TFMessage>("/tf", 10)),
      frames_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", 1, /*latch=*/true)),
      repeater_(std::chrono::milliseconds(10), [this] { step(); }) {
  tool_.publish(needle());
  frames_.publish(frames());
}

void MotionWorld::step() {
  const std::lock_guard lock(mutex_);
  const ros::Time now = ros::Time::now();
  sweep_guard::Warning warning;
  warning.header.stamp = now;
  warning.level = state_.level;
  warning.reasons = state_.reasons;
  if (state_.warns) warning_.publish(warning);
  if (state_.finds_planes) planes_.publish(wall(now, state_.X_WT, state_.wall));
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = now - state_.pose_age;
  pose.header.frame_id = "world";
  pose.pose = toMsg(state_.X_WT);
  if (state_.has_pose) {
    pose_.publish(pose);
    const Eigen::Isometry3d X_WJ(Eigen::Translation3d(0.0, 0.0, 0.5));
    joints_.publish(joined("world", "joint", X_WJ, now));
    joints_.publish(joined("joint", "tool", X_WJ.inverse() * state_.X_WT, now));
  }
  if (state_.command) state_.command(now);
}

}  // namespace sweep_guard_ros
