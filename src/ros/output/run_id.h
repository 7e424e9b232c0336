#pragma once

#include <string>

namespace sweep_guard_ros {

/// Returns another name in each run, for Warning::run_id.
std::string randomRunId();

}  // namespace sweep_guard_ros
