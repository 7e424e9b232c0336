#pragma once

#include <string>

#include "ros/motion/pose_source.h"

namespace sweep_guard_ros {

/// Reads fixed_frame, tool_source (kTopic or kTf) and tool_frame. The caller sets `silence`.
PoseSource readPoseSource(ParameterReader& read);

/// Reads the name of the guard's node, and resolves it.
/// @throws sweep_guard_core::InvalidInput if it is no name of a node
std::string readGuard(ParameterReader& read);

/// Reads a number of seconds.
/// @param range  its unit is s
sweep_guard_core::Duration readSeconds(ParameterReader& read, const std::string& key,
                                       sweep_guard_core::Duration fallback, const ParameterRange& range,
                                       const std::string& effect);

}  // namespace sweep_guard_ros
