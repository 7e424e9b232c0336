#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_simulation {

/// Returns the center of the front face of a tool [m], where it reaches farthest in a direction. A point of the tool.
/// @param direction_T  unit
Eigen::Vector3d frontOf(const sweep_guard_core::Tool& tool, const Eigen::Vector3d& direction_T);

/// Returns the tip of a tool [m]: its front along z of its frame; the origin for a cylinder.
Eigen::Vector3d tipOf(const sweep_guard_core::Tool& tool);

/// Returns an upper bound on the distance of any tool point from the line through the tip along z [m].
double radialExtent(const sweep_guard_core::Tool& tool);

}  // namespace sweep_guard_simulation
