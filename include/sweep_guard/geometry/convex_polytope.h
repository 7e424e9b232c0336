#pragma once

#include <vector>

#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_core {

/// Returns the faces of the intersection of half-spaces, in the frame of these: one convex polygon [m] for each
/// half-space that bounds it, counter-clockwise seen from outside, in their order. A redundant half-space has no face;
/// if its plane touches the intersection, it may have a face without area. An empty intersection has no faces.
/// @param half_spaces  each once; their intersection must be bounded (not checked). The time grows faster than the
///                     square of their number: at most a few dozen
/// @param radius       the intersection lies within this distance of the origin [m], > 0; not checked
std::vector<Polygon> polytopeFaces(const std::vector<HalfSpace>& half_spaces, double radius);

/// Returns the volume [m^3] of the convex polytope with these faces from polytopeFaces(); 0 if there are none.
double polytopeVolume(const std::vector<Polygon>& faces);

}  // namespace sweep_guard_core
