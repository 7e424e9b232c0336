#include <pluginlib/class_list_macros.hpp>

#include "ros/merger/warning_merger_node.h"
#include "ros/process/nodelet_of.h"

namespace sweep_guard_ros {
using WarningMergerNodelet = NodeletOf<WarningMergerNode>;
}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::WarningMergerNodelet, nodelet::Nodelet)
