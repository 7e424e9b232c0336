#pragma once

#include <filesystem>
#include <string>

namespace sweep_guard_ros {

/// Returns the folder that ROS gives nodes of this package to write to: $ROS_HOME/sweep_guard or ~/.ros/sweep_guard.
/// @param instead  parameter to set where neither is known
/// @throws sweep_guard_core::InvalidInput if both are not set
std::filesystem::path writableFolder(const std::string& instead);

}  // namespace sweep_guard_ros
