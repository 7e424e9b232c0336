#pragma once

#include <array>

#include "soundness/real.h"

namespace sweep_guard_core::soundness {

/// Returns the point of a triangle that is nearest to a point.
Vector3r nearestOfTriangle(const std::array<Vector3r, 3>& corners, const Vector3r& p);

}  // namespace sweep_guard_core::soundness
