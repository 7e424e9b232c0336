#pragma once

#include "scenes.h"
#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// Return randomScene() and grazingScene() as cases.
PairCase randomPairs(std::uint64_t seed);
PairCase grazingPairs(std::uint64_t seed);

/// Returns a case that is hard for float32 and for clipping. Volumes: 1e-6 to 1e3 m, up to 1e7 m from the origin, of
/// tools at rest, flat tools and needles. Triangles: at corners, edges and faces of the box and in its clips, 0 to 8
/// roundings or 1e-12 to 1e-2 of its size away, up to 1e6 times as large as the box, around it, in its faces; slivers,
/// needles, points.
PairCase adversarialPairs(std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
