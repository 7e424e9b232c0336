#pragma once

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Reads the parameters below `tool/`, and makes the tool from them.
/// @param before      has the same tool except for its padding; null: at the start
/// @param parameters  has source and frame of the tool; gets the rest
/// @throws sweep_guard_core::InvalidInput as loadParameters()
void readTool(ParameterReader& read, const Parameters* before, Parameters& parameters);

/// Makes pieces of all links of the robot description, if there is one. After readTool(); `before` as there.
/// @param parameters  gets them, or why there are none
void readRobotLinks(ParameterReader& read, const Parameters* before, Parameters& parameters);

/// Reads topic and type of what goes to the robot. After readTool().
/// @throws sweep_guard_core::InvalidInput if the type does not fit the tool
void readCommandSource(ParameterReader& read, Parameters& parameters);

}  // namespace sweep_guard_ros
