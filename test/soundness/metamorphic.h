#pragma once

#include "soundness/checks.h"

namespace sweep_guard_core::soundness {

/// Checks relations between answers, which need no oracle. A triangle that a detector names must also be named in
/// another description of the scene, if the volume is grown by the rounding errors of both: moved rigidly, triangles or
/// corners in another order, wound the other way, every triangle twice or cut in four, more triangles, a larger volume.
/// Scaled by a power of two, the answer must be the same in every bit.
void checkRelations(const Context& context, const PairCase& pair);

/// Checks relations between sweeps. The contacts of a sweep must be named when time runs backwards, when the sweep is
/// cut in two, with a larger tool, and when everything is moved. Scaled by a power of two, the answer must be the same.
/// A path must meet everything that its first poses meet.
void checkRelations(const Context& context, const SweepCase& sweep);

}  // namespace sweep_guard_core::soundness
