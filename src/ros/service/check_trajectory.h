#pragma once

#include <sweep_guard/CheckTrajectory.h>

#include "ros/service/path_tests.h"

namespace sweep_guard_ros {

/// Answers a call of `~check_trajectory`: sweeps the links of a robot, moved by their joints, against the workpieces as
/// they are now. For PathService.
void checkTrajectory(PathTests& tests, sweep_guard_core::SteadyTime arrival,
                     const sweep_guard::CheckTrajectory::Request& request,
                     sweep_guard::CheckTrajectory::Response& response);

}  // namespace sweep_guard_ros
