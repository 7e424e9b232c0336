#pragma once

#include <optional>
#include <string>

#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_ros {

/// Returns the surface in an answer of mesh_reader (MeshWireHeader); empty if the answer is malformed. The reader has read
/// hostile bytes, so its answer may be hostile, too.
std::optional<MeshSurface> surfaceFrom(const std::string& answer);

}  // namespace sweep_guard_ros
