#pragma once

#include <string>

namespace sweep_guard_recording {

/// The bytes of a file.
/// @throws sweep_guard_core::InvalidInput if it is not a regular file (a device or pipe might never end), cannot be read or
/// is larger
///     than 256 MiB
std::string readFile(const std::string& path);

}  // namespace sweep_guard_recording
