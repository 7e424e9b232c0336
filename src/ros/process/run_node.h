#pragma once

#include <chrono>
#include <functional>
#include <memory>

namespace sweep_guard_ros {

constexpr auto kTimeToEnd = std::chrono::milliseconds(800);

/// Runs the node of a program until it is asked to end.
/// @param name         of the node, where the command line gives no other
/// @param start        returns the node, at work; called once there is a handle for it
/// @param time_to_end  that the node has from the request on; then the process ends without it
/// @returns the exit status: 2 if it cannot start, for which start() throws sweep_guard_core::Error
int runNode(const char* name, int argc, char** argv, const std::function<std::shared_ptr<void>()>& start,
            std::chrono::milliseconds time_to_end = kTimeToEnd);

}  // namespace sweep_guard_ros
