#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Returns whether a closed mesh encloses a point: a ray from the point crosses the surface an odd number of times. An
/// edge on the ray counts with exactly one of its triangles despite rounding, because both evaluate it from the same
/// end. A point on the surface may count as inside or outside.
/// @param mesh_M  closed(); its triangles may be of either winding
/// @param p_M     [m]
bool inside(const TriangleMesh& mesh_M, const Eigen::Vector3d& p_M);

}  // namespace sweep_guard_core
