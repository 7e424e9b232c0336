#pragma once

#include <vector>

#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {

/// Returns the faces of the intersection of half-spaces: one convex polygon for each half-space that bounds it,
/// counter-clockwise seen from outside. A redundant half-space has no face; if its plane touches the intersection, it
/// may have a face without area.
/// @param half_spaces  at most a few dozen, each once; their intersection must be bounded
/// @param radius       the intersection lies within this distance of the origin [m]
std::vector<Polygon> polytopeFaces(const std::vector<HalfSpace>& half_spaces, double radius);

/// Returns the volume [m^3] of the convex polytope with these faces from polytopeFaces(); 0 if there are none.
double polytopeVolume(const std::vector<Polygon>& faces);

}  // namespace sweep_guard_core
