#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "prediction/profile.h"

namespace sweep_guard_ros {

/// Reads a profile.
/// @throws sweep_guard_core::InvalidInput that names the file if its path is not absolute, it is not a regular file, it
///     cannot be read, or it is no profile for this guard
std::shared_ptr<const sweep_guard_core::Profile> readProfile(const std::filesystem::path& file);

/// Writes a profile in one step: the file is always a whole profile, the old one or the new one. Makes its folder.
/// @throws sweep_guard_core::Error that names the file if it cannot be written; then it is as it was
void writeProfile(const std::filesystem::path& file, const sweep_guard_core::Profile& profile);

/// Returns the file of a profile with a plain name, in the folder that ROS gives nodes to write to: $ROS_HOME/sweep_guard
/// or ~/.ros/sweep_guard.
/// @throws sweep_guard_core::InvalidInput if the name has other characters than letters, digits, - and _, or is longer
///     than 64; or if it would be one file too many there
std::filesystem::path profileNamed(const std::string& name);

}  // namespace sweep_guard_ros
