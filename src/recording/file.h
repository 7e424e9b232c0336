#pragma once

#include <string>

namespace sweep_guard_recording {

/// Returns the bytes of a file.
/// @throws sweep_guard_core::InvalidInput if it is not a regular file (reading a device or a pipe might never end),
///     cannot be read, or is larger than 256 MiB
std::string readFile(const std::string& path);

}  // namespace sweep_guard_recording
