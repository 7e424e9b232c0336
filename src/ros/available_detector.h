#pragma once

#include <string>

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Returns the parameters with a detector that this machine can make. Warns if `select` was replaced.
Parameters withAvailableDetector(Parameters parameters);

/// Describes a detector for people: its name, and the OpenGL library or the instruction set that it runs on.
std::string describe(const sweep_guard_core::DetectorChoice& detector);

}  // namespace sweep_guard_ros
