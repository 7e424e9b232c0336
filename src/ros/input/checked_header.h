#pragma once

#include <std_msgs/Header.h>

namespace sweep_guard_ros {

/// Throws unless a header names a frame and its stamp does not lie in the future.
/// @throws sweep_guard_core::InvalidInput
void checkHeader(const std_msgs::Header& header);

}  // namespace sweep_guard_ros
