#pragma once

#include <chrono>

namespace sweep_guard_ros {

/// Waits until roscpp has handed what was published to the kernel; does not wait for subscribers that do not read.
/// Publishers that are destroyed drop what they still hold.
void flush(std::chrono::milliseconds longest);

}  // namespace sweep_guard_ros
