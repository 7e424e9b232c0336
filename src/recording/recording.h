#pragma once

#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_recording {

/// A recorded motion and its name in tables and plots.
struct Recording {
  std::string name;                                  ///< file name without folder and extension
  std::vector<sweep_guard_core::StampedPose> poses;  ///< at least one; stamps do not decrease
};

/// Reads a motion file or a rosbag.
/// @param topic  of a rosbag; empty: the only topic with poses
/// @throws sweep_guard_core::InvalidInput as readMotionFile() and readBag() do
Recording readRecording(const std::string& path, const std::string& topic);

}  // namespace sweep_guard_recording
