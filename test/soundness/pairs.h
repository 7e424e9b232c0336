#pragma once

#include "scenes.h"
#include "soundness/cases.h"

namespace sweep_guard_core::soundness {

/// The scenes of the detectors' own tests: triangles of every kind around the volume, and triangles that only just
/// touch it or only just do not.
PairCase randomPairs(std::uint64_t seed);
PairCase grazingPairs(std::uint64_t seed);

/// What is hardest for float32 and for clipping: volumes of 1e-6 to 1e3 m, up to 1e7 m from the origin, of tools at
/// rest, flat ones and needles; triangles at the corners, edges and faces of the box and in its clipping planes, 0 to 8
/// roundings or 1e-12 to 1e-2 of its size away, 2 to 1e6 times as large as the box, around all of it, in its faces,
/// slivers, needles and points.
PairCase adversarialPairs(std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
