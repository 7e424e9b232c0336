#pragma once

#include <tf2/buffer_core.h>

#include <string>

namespace sweep_guard_ros {

/// Returns whether the transform to a frame from its parent is one of those that make up the newest transform between two others.
bool liesBetween(const std::string& frame, const std::string& target, const std::string& source,
                 const tf2::BufferCore& buffer);

}  // namespace sweep_guard_ros
