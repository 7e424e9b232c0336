#pragma once

#include "geometry/patches.h"
#include "geometry/welded_surface.h"

namespace sweep_guard_core {

/// Leaves out patches that enclose nothing, as a fin or a plate inside: those that have an odd number of triangles at
/// an edge where the number of all is odd and above 2, and at no edge where it is even. Of several at such an edge only
/// the smallest one is left out, so no new border appears.
/// @returns whether any was left out
bool leaveOutAppendages(WeldedSurface& surface, const Patches& patches);

}  // namespace sweep_guard_core
