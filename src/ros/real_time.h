#pragma once

#include <string>

namespace sweep_guard_ros {

/// Gives the calling thread a real-time priority (SCHED_FIFO).
/// @param priority  1 to 99
/// @returns the reason of a refusal, and what to set; empty if granted
std::string requestRealTime(int priority);

}  // namespace sweep_guard_ros
