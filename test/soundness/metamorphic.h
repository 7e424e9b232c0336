#pragma once

#include "soundness/checks.h"

namespace sweep_guard_core::soundness {

/// Relations between answers, for which no oracle is needed. What a detector names in one scene it has to name in
/// another that is the same but for its description, once the volume is grown by what rounding can do in both: moved
/// rigidly, triangles in another order, corners in another order, wound the other way, every triangle twice, each cut
/// in four, more triangles added, the volume grown. Scaled by a power of two, the answer has to be the same, bit by
/// bit.
void checkRelations(const Context& context, const PairCase& pair);

/// Relations between sweeps. The contacts of a sweep have to be named when time runs backwards, when the sweep is cut
/// in two, by a larger tool, and when everything is moved; scaled by a power of two, the answer is the same; what the
/// first poses of a path meet, the whole path meets.
void checkRelations(const Context& context, const SweepCase& sweep);

}  // namespace sweep_guard_core::soundness
