#pragma once

#include "scenes.h"
#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// A moving tool and triangles through exactly known points of it: at a known fraction of the motion a point of the
/// tool, `k` roundings inside of its surface, lies on the triangle to within those. So each triangle is met, and
/// nothing of the product was asked to know it.
///
/// Tools from 1e-6 to 1e3 m: cylinders, flat ones and needles, and up to five bodies of any kind; rotations 0, 1e-9
/// rad, any, 90, 179.999 and 180 degrees; at rest, going, turning, meshes that move meanwhile, all this seen from a
/// frame that turns; up to 1e7 m from the origin. Points on the hull of the whole sweep, on silhouettes, at the joints
/// of split(), anywhere in the tool. Triangles of 1e-6 to 1e6 tool sizes touching with a corner, an edge or their
/// inside: across, tangent, leaning away; slivers, needles, points. One in two cases has one triangle in float32, and
/// the tool is moved to it: then only the last digits are in doubt.
SweepCase constructedPositives(std::uint64_t seed);

/// A rotation angle in [0, pi]: none, tiny, any, a right angle, almost or exactly half a turn.
double randomAngle(Random& random);

/// The motions and options alone, without a triangle.
SweepCase randomSweep(Random& random);

}  // namespace sweep_guard_core::soundness
