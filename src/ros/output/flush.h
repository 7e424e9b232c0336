#pragma once

#include <chrono>

namespace sweep_guard_ros {

/// Waits, for at most 0.2 s, until roscpp has handed what was published to the kernel; does not wait for subscribers
/// that do not read. Publishers that are destroyed drop what they still hold.
void flush();

}  // namespace sweep_guard_ros
