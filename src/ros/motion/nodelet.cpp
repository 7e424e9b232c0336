#include <pluginlib/class_list_macros.hpp>

#include "ros/motion/motion_guard_node.h"
#include "ros/process/nodelet_of.h"

namespace sweep_guard_ros {
using MotionGuardNodelet = NodeletOf<MotionGuardNode>;
}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::MotionGuardNodelet, nodelet::Nodelet)
