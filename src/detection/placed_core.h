#pragma once

#include <algorithm>
#include <array>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// A piece at a pose, without its padding: GJK needs fewer steps for a segment than for a capsule, and the direction to it has
/// more exact digits.
struct PlacedCore {
  const ConvexShape& shape_T;
  Eigen::Matrix3d R_MT;
  Eigen::Vector3d p_MT;

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction_M) const {
    return p_MT + R_MT * shape_T.coreSupportPoint(R_MT.transpose() * direction_M);
  }

  Eigen::Vector3d inTool(const Eigen::Vector3d& p_M) const { return R_MT.transpose() * (p_M - p_MT); }

  // Returns whether this, moved out of a triangle by its depth along a normal, touches a corner, up to a tolerance [m].
  bool touchesACorner(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal, double depth,
                      double tolerance) const {
    const double reach = std::max({normal.dot(corners[0]), normal.dot(corners[1]), normal.dot(corners[2])});
    return std::any_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
      const Eigen::Vector3d p = corner - (depth - tolerance) * normal;
      return normal.dot(corner) > reach - tolerance && shape_T.depthOf(inTool(p)).depth >= shape_T.padding();
    });
  }

  Eigen::Vector3d proposeNormal(const std::array<Eigen::Vector3d, 3>& corners) const {
    return R_MT * shape_T.proposeNormal({inTool(corners[0]), inTool(corners[1]), inTool(corners[2])});
  }
};

}  // namespace sweep_guard_core
