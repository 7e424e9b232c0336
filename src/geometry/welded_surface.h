#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "geometry/edge_groups.h"
#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// A surface in which corners at one place are one corner.
struct WeldedSurface {
  size_t vertexCount() const { return positions.size() / 3; }
  Eigen::Vector3d at(std::uint32_t vertex) const {
    return Eigen::Map<const Eigen::Vector3f>(&positions[3 * size_t{vertex}]).cast<double>();
  }
  double diagonal() const;  ///< of the box around all vertices [m]
  EdgeGroups edges() const { return {triangles, left_out, vertexCount()}; }

  /// Welds corners, and leaves out triangles that become lines or have the corners of an earlier one. Returns the edges.
  EdgeGroups weld();

  const std::vector<float>& positions;  ///< x0 y0 z0 x1 ... [m], finite
  std::vector<Triangle> triangles;
  std::vector<bool> left_out;
  std::vector<bool> both_ways;  ///< sent in both directions
};

inline bool isDegenerate(const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return a == b || b == c || c == a;
}

inline Triangle turnedIf(bool turn, const Triangle& triangle) {
  return turn ? Triangle{triangle[0], triangle[2], triangle[1]} : triangle;
}

}  // namespace sweep_guard_core
