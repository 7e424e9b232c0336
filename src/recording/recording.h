#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_recording {

/// Returns the bytes of a file.
/// @throws sweep_guard_core::InvalidInput if it is not a regular file (reading a device or a pipe might never end),
///     cannot be read, or is larger than 256 MiB
std::string readFile(const std::string& path);

/// Reads a recorded motion from a text file: one pose `stamp tx ty tz qx qy qz qw` per line (s, m, quaternion of any
/// length). Skips empty lines and lines that begin with `#`. Numbers have decimal points in every locale. Stamps are
/// rounded to nanoseconds; equal stamps are kept, because some recorders write few digits.
/// @return the poses in the order of the file, at least one, with orthonormal rotations
/// @throws sweep_guard_core::InvalidInput, with file and line, if the file cannot be read or is larger than 256 MiB, a
///     line is not eight finite numbers, a quaternion is zero, a stamp is earlier than the previous one, or there is no
///     pose
std::vector<sweep_guard_core::StampedPose> readMotionFile(const std::string& path);

/// A recorded motion and its name in tables and plots.
struct Recording {
  std::string name;                                          ///< file name without folder and extension
  std::vector<sweep_guard_core::StampedPose> poses;          ///< at least one; stamps do not decrease
  std::vector<sweep_guard_core::StampedPose> commands = {};  ///< poses that go to the robot; empty: not known
};

/// Reads a motion file or a rosbag.
/// @param topic    of a rosbag; empty: the only topic with poses
/// @param command  topic of the commands of a rosbag; empty: none
/// @throws sweep_guard_core::InvalidInput as readMotionFile() and readBag() do
Recording readRecording(const std::string& path, const std::string& topic, const std::string& command = {});

}  // namespace sweep_guard_recording
