#pragma once

#include <sweep_guard/CheckSweep.h>

#include "ros/service/path_tests.h"

namespace sweep_guard_ros {

/// Answers a call of `~check_sweep`: sweeps a path of poses against the workpieces as they are now. For PathService.
void checkSweep(PathTests& tests, sweep_guard_core::SteadyTime arrival, const sweep_guard::CheckSweep::Request& request,
                sweep_guard::CheckSweep::Response& response);

}  // namespace sweep_guard_ros
