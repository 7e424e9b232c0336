#pragma once

#include <string>

namespace sweep_guard_ros {

/// Returns that nobody publishes the warning of a guard, and which argument of the launch files names another guard.
/// @param guard  name of its node, resolved
std::string absentGuardText(const std::string& guard);

/// The same for a node that is given the topic of the warning.
/// @param topic  resolved
std::string absentWarningText(const std::string& topic);

}  // namespace sweep_guard_ros
