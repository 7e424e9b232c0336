#include <pluginlib/class_list_macros.hpp>

#include "ros/process/nodelet_of.h"
#include "ros/scene/scene_input_node.h"

namespace sweep_guard_ros {
using SceneInputNodelet = NodeletOf<SceneInputNode>;
}  // namespace sweep_guard_ros

PLUGINLIB_EXPORT_CLASS(sweep_guard_ros::SceneInputNodelet, nodelet::Nodelet)
