#pragma once

#include "scenes.h"
#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// Returns a moving tool and triangles through exactly known points of it: at a known fraction of the motion, a point
/// of the tool lies on the triangle. The point is some roundings deep in the tool, and its distance from the triangle
/// is less than that. So each triangle is met, and the product was not used to find out.
///
/// Tools: 1e-6 to 1e3 m; cylinders, also flat ones and needles, and up to five bodies of any kind. Motions: up to 1e7 m
/// from the origin; at rest, translating, turning by 0, 1e-12 rad to 180 degrees; meshes that move; a frame that turns.
/// Points:
/// on the hull of the whole sweep, on silhouettes, at the joints of split(), anywhere in the tool. Triangles: 1e-6 to
/// 1e6 tool sizes; touching with a corner, an edge or their interior; across, tangent, leaning away; slivers, needles,
/// points.
/// In one of two cases the only triangle is in float32 and the tool is moved to it, so that only the last digits are
/// uncertain.
SweepCase constructedPositives(std::uint64_t seed);

/// Returns a rotation angle in [0, pi]: zero, tiny, random, a right angle, almost or exactly half a turn.
double randomAngle(Random& random);

/// Returns tool, motion and options without triangles.
SweepCase randomSweep(Random& random);

}  // namespace sweep_guard_core::soundness
