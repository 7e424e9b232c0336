#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_simulation {

/// What a tool is led by: the middle of its front face, where it is farthest along z of the tool frame [m]. A point of
/// the tool; the origin, for a cylinder.
Eigen::Vector3d tipOf(const sweep_guard_core::Tool& tool);

/// Largest distance of a tool point from the line through the tip along z [m], at most.
double radialExtent(const sweep_guard_core::Tool& tool);

}  // namespace sweep_guard_simulation
