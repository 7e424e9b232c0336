#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// The rigid motion of a mesh that fits best other positions of its vertices: least squares [Umeyama 1991].
struct RigidFit {
  Eigen::Isometry3d X_MM = Eigen::Isometry3d::Identity();
  double deviation;  ///< of the vertex that it leaves farthest away [m]; infinite if a position is not finite
};

/// @param positions_M  x0 y0 z0 x1 ... [m], as many as the mesh has vertices (asserted)
RigidFit rigidFit(const TriangleMesh& mesh_M, const std::vector<float>& positions_M);
/// @param moved_M  with as many vertices (asserted)
RigidFit rigidFit(const TriangleMesh& mesh_M, const TriangleMesh& moved_M);

bool sameTriangles(const TriangleMesh& a, const TriangleMesh& b);  ///< and as many vertices

}  // namespace sweep_guard_core
