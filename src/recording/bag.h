#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_recording {

/// Returns whether a file begins like a rosbag; false if it cannot be read.
bool isBag(const std::string& path);

/// Reads a recorded motion from one topic of a rosbag: geometry_msgs/PoseStamped or TransformStamped. Takes the stamps
/// from the headers and keeps equal ones.
/// @param topic  empty: the only topic of these types
/// @return the poses in the order of the bag, at least one, with orthonormal rotations
/// @throws sweep_guard_core::InvalidInput if the file cannot be read or is no bag, if the topic is missing or there are
///     several to choose from (the message lists them), if fromMsg() refuses a pose, a stamp is earlier than the
///     previous one, or the frames change
std::vector<sweep_guard_core::StampedPose> readBag(const std::string& path, const std::string& topic);

}  // namespace sweep_guard_recording
