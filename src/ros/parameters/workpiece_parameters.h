#pragma once

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Reads the rules of workpieces, and the cameras, whose timeouts are rules of their own.
/// @param parameters  gets them
/// @throws sweep_guard_core::InvalidInput as loadParameters()
void readWorkpieces(ParameterReader& read, Parameters& parameters);

}  // namespace sweep_guard_ros
