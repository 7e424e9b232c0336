#include <pluginlib/class_list_macros.hpp>

#include "ros/haptics/haptics_node.h"
#include "ros/process/nodelet_of.h"

namespace sweep_guard_ros {
using HapticsNodelet = NodeletOf<HapticsNode>;
}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::HapticsNodelet, nodelet::Nodelet)
