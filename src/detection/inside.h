#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Returns whether the surface of a mesh encloses a point: its closed parts wind around the point, or the generalized
/// winding number [Jacobson 2013] of an open part, or of all open parts together, exceeds 0.75. A point on the surface
/// may count as inside or outside. If the mesh is not closed(), false may also mean that it cannot be known.
/// @param p_M  [m]
bool inside(const TriangleMesh& mesh_M, const Eigen::Vector3d& p_M);

}  // namespace sweep_guard_core
