#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_recording {

/// Positions of some joints at one time.
struct RecordedJoints {
  sweep_guard_core::Time stamp;
  std::vector<double> positions;  ///< in the order of the names that were asked for [rad or m]
};

/// Reads the positions of joints from the sensor_msgs/JointState of a rosbag. Messages that lack one of the joints, or are
/// not later than the one before, are left out.
/// @param topic  empty: all topics of this type
/// @param names  of the joints
/// @return in the order of the bag, at least one
/// @throws sweep_guard_core::InvalidInput if the file cannot be read or is no bag, if no message has all joints, or if a
///     position is not finite
std::vector<RecordedJoints> readJointBag(const std::string& path, const std::string& topic,
                                         const std::vector<std::string>& names);

}  // namespace sweep_guard_recording
