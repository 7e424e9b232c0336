#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace sweep_guard {

/// Volume [m^3] of the convex hull of some points; empty if this was built without Qhull.
std::optional<double> hullVolume(const std::vector<Eigen::Vector3d>& points);

}  // namespace sweep_guard
