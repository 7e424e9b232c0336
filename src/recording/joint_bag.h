#pragma once

#include <sensor_msgs/JointState.h>

#include <functional>
#include <string>

namespace sweep_guard_recording {

/// Has each sensor_msgs/JointState on one topic of a rosbag read, in the order of the bag.
/// @param topic  empty: the only topic of this type
/// @param read   takes the name of the node that published the message, and the message
/// @throws sweep_guard_core::InvalidInput as readBag() does, or naming the message if `read` throws one
void readJointBag(const std::string& path, const std::string& topic,
                  const std::function<void(const std::string& publisher, const sensor_msgs::JointState&)>& read);

}  // namespace sweep_guard_recording
