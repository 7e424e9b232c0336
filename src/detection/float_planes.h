#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// Converts the planes of a volume to float32, for tests against the offsets of a mesh's vertices. Points between
/// `outside` and `inside` are in doubt because of rounding: 2^-20 of the mesh's radius plus the plane's distance from
/// its origin, three times the largest rounding error.
/// @param outwards  distance [m] by which each plane of halfSpaces_B() is moved out; empty: 0
simd::Planes floatPlanes(const TriangleMesh& mesh_M, const SweptVolume& swept_M, const PerHalfSpace& outwards = {});

/// Converts the sides of a box along the axes of M [m]; the box may be infinite.
simd::Planes floatPlanes(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M);

}  // namespace sweep_guard_core
