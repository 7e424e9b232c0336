#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <string>

#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {

/// Returns the message that says where the frame `child` is in the frame `parent`.
inline geometry_msgs::TransformStamped transformMsg(const std::string& parent, const std::string& child,
                                                    const Eigen::Isometry3d& X_PC, const ros::Time& stamp = {}) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = parent;
  transform.header.stamp = stamp;
  transform.child_frame_id = child;
  transform.transform.translation = vectorMsg<geometry_msgs::Vector3>(X_PC.translation());
  transform.transform.rotation =
      sweep_guard_ros::toMsg(X_PC).orientation;  // qualified: tf2_eigen has a toMsg() in namespace Eigen
  return transform;
}

}  // namespace sweep_guard_ros
