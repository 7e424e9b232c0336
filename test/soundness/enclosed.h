#pragma once

#include "soundness/checks.h"

namespace sweep_guard_core::soundness {

/// Makes one to three solids, cubes and octahedra under affine maps, apart, overlapping or in each other, and sends their
/// surfaces as strangers do: triangles of their own corners, doubled, turned, with corners that differ by rounding, with
/// fins, plates, sheets and holes, and deformed. Checks for points off the surfaces that inside() says what the maps say;
/// of a solid with a hole, what a sum of solid angles in long double says.
void checkEnclosed(const Context& context, std::uint64_t seed);

}  // namespace sweep_guard_core::soundness
