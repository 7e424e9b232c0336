#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_recording {

/// Whether a file begins as a rosbag does. False for one that cannot be read.
bool isBag(const std::string& path);

/// Reads a recorded motion from a rosbag: one topic of geometry_msgs/PoseStamped or TransformStamped. The stamps are
/// those of the headers; equal ones are kept.
/// @param topic  empty: the only one of these types
/// @returns the poses in the order of the bag, at least one, their rotations orthonormal
/// @throws sweep_guard_core::InvalidInput if the file cannot be read or is no bag, if the topic is not in it or there is a
/// choice of topics
///     (they are listed), if a pose is refused by fromMsg(), a stamp is earlier than the one before, or the frames
///     change
std::vector<sweep_guard_core::StampedPose> readBag(const std::string& path, const std::string& topic);

}  // namespace sweep_guard_recording
