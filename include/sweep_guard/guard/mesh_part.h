#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard {

/// Some triangles of a mesh, and the vertices that they use.
struct MeshPart {
  std::vector<std::uint32_t> triangles;  ///< ascending
  std::vector<Triangle> corners;         ///< of each of them: indices into `vertices`
  std::vector<std::uint32_t> vertices;   ///< each once
};

/// The triangles that may reach into a box: those left out lie wholly beyond one of its sides. One pass over the mesh.
/// @param box_M  along the axes of M [m]; may be infinite
MeshPart partWithin(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M);

/// Those of a part.
MeshPart partWithin(const TriangleMesh& mesh_M, const MeshPart& part, const Eigen::AlignedBox3d& box_M);

}  // namespace sweep_guard
