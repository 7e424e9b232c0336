#pragma once

#include <boost/container/static_vector.hpp>

#include "sweep_guard/geometry/half_space.h"
#include "sweep_guard/geometry/oriented_box.h"

namespace sweep_guard_core {

/// As many clipping planes as every OpenGL has, at most.
constexpr size_t kMaxClips = 6;
using Clips = boost::container::static_vector<HalfSpace, kMaxClips>;

/// The planes that cut the box down to what a body of the tool sweeps: at most two side planes (SCP) and two frontal
/// planes (FCP), all parallel to the X axis of the box [P, Sec. 3.1, Fig. 5]. In box frame B [m].
///
/// A side plane runs through an extreme point of a front face and one of a rear face, a frontal plane through extreme
/// points of the front (or rear) faces at both poses. Of the lines that Fig. 5 allows, the one that cuts most off
/// the box is taken, and pushed out until it touches the body itself: so no plane can cut off a point of it, whatever
/// its shape and its motion. A plane that would leave the box as it is is left out.
Clips boundingPlanes(const ConvexShape& shape, const Motion& motion, const OrientedBox& box);

}  // namespace sweep_guard_core
