#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Whether a point is enclosed by a closed mesh: a ray from it crosses the surface an odd number of times. An edge that
/// the ray runs through counts with one of its triangles, whatever the rounding: it is looked at from one end only.
/// Points of the surface are on either side.
/// @param mesh_M  closed(); its triangles may be of either winding
/// @param p_M     [m]
bool inside(const TriangleMesh& mesh_M, const Eigen::Vector3d& p_M);

}  // namespace sweep_guard_core
