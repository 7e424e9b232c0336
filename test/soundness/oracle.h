#pragma once

#include <cstdint>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core::soundness {

/// Returns exactly whether a triangle meets a volume grown by `growth` [m]. Long double decides where its error bound
/// allows; meetsExactly() decides the rest in integers. Thousands of times faster than meetsExactly() alone.
bool meets(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M, double growth = 0.0);

/// Decides the same with CGAL: a linear program over rationals for a point of the triangle inside all planes. Shares
/// only the numbers with meets().
bool meetsByLinearProgram(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M,
                          double growth = 0.0);

}  // namespace sweep_guard_core::soundness
