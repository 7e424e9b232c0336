#pragma once

#include <cmath>
#include <vector>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// Returns points on both rims of the round tool, in T [m]: their convex hull is the tool except for slivers.
inline std::vector<Eigen::Vector3d> roundToolPoints_T(const ConvexShape& tool, int points_per_rim) {
  constexpr double kTwoPi = 6.283185307179586;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < points_per_rim; ++i) {
    const double angle = kTwoPi * i / points_per_rim;
    for (const double z : {0.0, -tool.length()}) {
      points.emplace_back(tool.radius() * std::cos(angle), tool.radius() * std::sin(angle), z);
    }
  }
  return points;
}

}  // namespace sweep_guard_core
