#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/welded_surface.h"
#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// Returns whether two parts go through each other: an edge of one passes through a triangle of the other, even if the
/// solid with the edge is shrunk by `least`. Solids that only touch do not. Empty: there are too many triangles close
/// to those of other parts to tell.
///
/// Halves the box around all triangles until only one part is left in it, or few triangles.
/// @param triangles  grouped by part, counter-clockwise seen from outside the solid
/// @param parts      of each triangle
/// @param surface    that has their vertices
/// @param least      [m], > 0
std::optional<bool> partsCross(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& parts,
                               const WeldedSurface& surface, double least);

}  // namespace sweep_guard_core
