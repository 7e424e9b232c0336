#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

/// Returns how many points stand for each body of a tool: 64 for all of them, at least 16 for each.
constexpr size_t pointsPerBody(size_t bodies) { return std::max<size_t>(16, 64 / bodies); }

/// Boxes around the convex pieces of a body, in its frame B, and points spread evenly over them.
class BodyBoxes {
 public:
  static constexpr double kNear = 0.02;  ///< [m]

  /// @param points  as many for each piece; of more pieces than points, some have none
  BodyBoxes(const Tool& body, size_t points);

  const std::vector<Eigen::Vector3d>& points_B() const { return points_B_; }  ///< [m]
  bool isNear(const Eigen::Vector3d& p_B) const;  ///< a point [m] lies in a box that is larger by kNear on each side

 private:
  struct Box {
    Eigen::Isometry3d X_NB;        // N: its own frame, with the origin in its middle
    Eigen::Vector3d half_extents;  // [m]
  };

  static Box boxAround(const ConvexShape& shape_B);

  std::vector<Box> boxes_;
  std::vector<Eigen::Vector3d> points_B_;
};

/// Returns the i-th number of a sequence over [0, 1). Several of their dimensions, 0 to 3, spread points evenly.
double evenlySpread(size_t i, size_t dimension);

}  // namespace sweep_guard_core
