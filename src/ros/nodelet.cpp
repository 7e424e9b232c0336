#include <pluginlib/class_list_macros.hpp>

#include "ros/node.h"
#include "ros/process/nodelet_of.h"

namespace sweep_guard_ros {
using SweepGuardNodelet = NodeletOf<SweepGuardNode>;
}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::SweepGuardNodelet, nodelet::Nodelet)
