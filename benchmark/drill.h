#pragma once

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// Returns a drill of 10 x 100 mm.
inline ConvexShape drill() { return ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1); }

}  // namespace sweep_guard_core
