#pragma once

#include <cstdint>

#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core::soundness {

/// Whether a triangle meets a volume grown by `growth` [m]. Exact: long double answers where its rounding, bounded
/// safely, cannot matter; the rest is decided by meetsExactly() in integers. Thousands of times faster than that.
bool meets(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M, double growth = 0.0);

/// The same question to CGAL: is there a point of the triangle inside of all planes? A linear program, solved by CGAL's
/// exact solver over rationals. Shares nothing with meets() but the numbers.
bool meetsByLinearProgram(const TriangleMesh& mesh_M, std::uint32_t triangle, const SweptVolume& swept_M,
                          double growth = 0.0);

}  // namespace sweep_guard_core::soundness
