#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// Finds the vertices that triangles share if their corners are sent one by one. Remembers the triangles of the
/// previous call.
class Welding {
 public:
  /// Returns the triangles with one vertex for all corners at exactly the same position. Vertices are numbered in the
  /// order of their first corners. While the corners of each vertex of the previous call still agree, its triangles are
  /// returned again without a search. Vertices that have come to the same position then remain two, which is harmless:
  /// the surface is the same.
  /// @param corners  three for each triangle [m]; less than 2^32, not checked
  /// @throws InvalidInput if their number is not a multiple of 3, or naming the first corner that is not finite
  TriangleSurface weld(const std::vector<Eigen::Vector3d>& corners);

 private:
  bool agreesWith(const std::vector<Eigen::Vector3d>& corners) const;
  void search(const std::vector<Eigen::Vector3d>& corners);

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> first_corners_;  // of each vertex
};

}  // namespace sweep_guard_core
