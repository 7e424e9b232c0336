#pragma once

#include <string>

namespace sweep_guard_ros {

/// Returns a path with its percent escapes decoded, as rviz decodes it: `%20` is a blank. A percent sign that two hexadecimal digits
/// do not follow stays.
/// @throws sweep_guard_core::InvalidInput, with the reason alone, if an escape stands for a null character or a slash, or
///     makes a part of the path `.` or `..`
std::string percentDecoded(const std::string& path);

}  // namespace sweep_guard_ros
