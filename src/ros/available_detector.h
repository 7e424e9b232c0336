#pragma once

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Returns the parameters with a detector that this machine can make. Warns if `select` was replaced.
Parameters withAvailableDetector(Parameters parameters);

}  // namespace sweep_guard_ros
