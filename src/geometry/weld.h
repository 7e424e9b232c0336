#pragma once

#include <cstdint>
#include <vector>

namespace sweep_guard_core {

/// Returns for each vertex the first one at the same position.
/// @param positions  x0 y0 z0 x1 ... [m], finite
std::vector<std::uint32_t> firstAtPositions(const std::vector<float>& positions);

/// Welds vertices that lie near each other: each to the first of them within a distance that is not welded itself.
/// @param positions     x0 y0 z0 x1 ... [m], finite
/// @param vertices      those to weld: ascending, each the first at its position
/// @param distance      [m], >= 0
/// @param[in,out] first  for each vertex the one that represents it
/// @returns whether any was welded
bool weldNear(const std::vector<float>& positions, const std::vector<std::uint32_t>& vertices, double distance,
              std::vector<std::uint32_t>& first);

}  // namespace sweep_guard_core
