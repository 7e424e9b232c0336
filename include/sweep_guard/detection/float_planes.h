#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

/// The planes of a volume, as its mesh's offsets are tested against them in float32. Between `outside` and `inside`
/// lies what rounding leaves in doubt: 2^-20 of the mesh's radius and the plane's distance from its origin, a threefold
/// bound.
/// @param outwards  how far each plane of halfSpaces_B() is moved out [m]; empty: not at all
simd::Planes floatPlanes(const TriangleMesh& mesh_M, const SweptVolume& swept_M, const PerHalfSpace& outwards = {});

/// Those of a box along the axes of M [m]; may be infinite.
simd::Planes floatPlanes(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& box_M);

}  // namespace sweep_guard_core
