#pragma once

#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// Returns half-spaces that clip the box around a swept convex body more tightly: at most two side planes (SCP) and two
/// frontal planes (FCP), all parallel to the X axis of the box [P, Sec. 3.1, Fig. 5]. In box frame B [m].
///
/// A side plane runs through an extreme point of a front face and one of a rear face; a frontal plane runs through
/// extreme points of the front (or rear) faces at both poses. Of the lines in Fig. 5, the function takes the line that
/// cuts the largest area off the box, and moves it out until it touches the body. So no plane cuts off a point of the
/// body, for any shape and motion. Planes that cut nothing off the box are omitted.
Clips boundingPlanes(const ConvexShape& shape, const Motion& motion, const OrientedBox& box);

}  // namespace sweep_guard_core
