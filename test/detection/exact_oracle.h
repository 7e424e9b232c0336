#pragma once

#include <cstdint>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Whether a triangle meets a swept volume grown by `growth` [m], in integers of any length: no rounding at all, and no
/// clipping. A point of the triangle is its first corner plus u and v times two edges; each plane is then an
/// inequality in (u, v), and the triangle meets the volume if some corner of the region that they leave exists.
bool meetsExactly(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M, double growth = 0.0);

}  // namespace sweep_guard_core
