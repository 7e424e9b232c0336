#include <pluginlib/class_list_macros.hpp>

#include "ros/black_box/black_box_node.h"
#include "ros/process/nodelet_of.h"

namespace sweep_guard_ros {
using BlackBoxNodelet = NodeletOf<BlackBoxNode>;
}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::BlackBoxNodelet, nodelet::Nodelet)
