#pragma once

#include <shape_msgs/MeshTriangle.h>

#include <algorithm>
#include <vector>

namespace sweep_guard_rviz {

/// Returns whether all vertex indices are below the number of vertices.
inline bool indicesInRange(const std::vector<shape_msgs::MeshTriangle>& triangles, size_t vertices) {
  return std::all_of(triangles.begin(), triangles.end(), [&](const shape_msgs::MeshTriangle& triangle) {
    const auto& corners = triangle.vertex_indices;
    return std::all_of(corners.begin(), corners.end(), [&](auto corner) { return corner < vertices; });
  });
}

}  // namespace sweep_guard_rviz
