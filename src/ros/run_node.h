#pragma once

#include <functional>
#include <memory>

namespace sweep_guard_ros {

/// Runs the node of a program until it is asked to end.
/// @param name   of the node, where the command line gives no other
/// @param start  returns the node, at work; called once there is a handle for it
/// @returns the exit status: 2 if it cannot start, for which start() throws sweep_guard_core::Error
int runNode(const char* name, int argc, char** argv, const std::function<std::shared_ptr<void>()>& start);

}  // namespace sweep_guard_ros
