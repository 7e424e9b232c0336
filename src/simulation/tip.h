#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_simulation {

/// Returns the tip of a tool [m]: the center of the front face, where the tool reaches farthest along z of its frame. A
/// point of the tool; the origin for a cylinder.
Eigen::Vector3d tipOf(const sweep_guard_core::Tool& tool);

/// Returns an upper bound on the distance of any tool point from the line through the tip along z [m].
double radialExtent(const sweep_guard_core::Tool& tool);

}  // namespace sweep_guard_simulation
