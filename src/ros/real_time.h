#pragma once

#include <string>

namespace sweep_guard_ros {

/// Asks the system to run the calling thread before all ordinary ones, first in, first out (SCHED_FIFO).
/// @param priority  1 to 99
/// @returns why the system refuses, and what to set so that it does not; empty: it does so from now on
std::string askForRealTime(int priority);

}  // namespace sweep_guard_ros
