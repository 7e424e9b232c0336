#pragma once

#include <string>

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Where the tool and the planes around it are.
struct SourceFrames {
  std::string fixed_frame;  ///< of the planes
  ToolSource tool_source;   ///< kTopic or kTf
  std::string tool_frame;
};

/// Reads fixed_frame, tool_source and tool_frame.
SourceFrames readSourceFrames(ParameterReader& read);

/// Reads the name of the guard's node.
/// @throws sweep_guard_core::InvalidInput if it is no name of a node
std::string readGuard(ParameterReader& read);

/// Reads a number of seconds.
/// @param range  its unit is s
sweep_guard_core::Duration readSeconds(ParameterReader& read, const std::string& key,
                                       sweep_guard_core::Duration fallback, const ParameterRange& range,
                                       const std::string& effect);

}  // namespace sweep_guard_ros
