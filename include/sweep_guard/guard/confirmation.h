#pragma once

#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <vector>

#include "sweep_guard/detection/fine_phase.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/moving_mesh.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {

/// A triangle that the tool touches, and how.
struct TouchedTriangle {
  std::uint32_t triangle;
  size_t part;    ///< of the tool: the one that touches first
  Impact impact;  ///< its first
};

/// By triangle, the normals along which the tool came in: unit, from the triangle to the tool, in the mesh's frame.
using WaysIn = boost::container::flat_map<std::uint32_t, Eigen::Vector3d>;

/// What the fine phase makes of candidates.
struct Confirmation {
  /// Candidates that are not proven to be missed: ascending, each once. A mesh that moves does so at any pace; besides
  /// those touched at an even pace, the ones are among them whose hull before and after meets that of the tool.
  TriangleSet met;
  std::vector<TouchedTriangle> touched;  ///< ascending, each triangle once; if the mesh moves, at an even pace
};

/// Takes a closer look at candidates [P, Sec. 5: "a fine detection"].
/// @param parts       of one motion, of equal duration, end to end
/// @param candidates  for each part of the tool
/// @param margin      the tool is grown by this [m], >= 0
/// @param[out] confirmation  what was in it is replaced
void confirm(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh,
             const std::vector<TriangleSet>& candidates, double margin, const WaysIn& ways_in,
             Confirmation& confirmation);

}  // namespace sweep_guard
