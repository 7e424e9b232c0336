#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "interaction/polygon_cutter.h"

namespace sweep_guard_core {

/// A convex polygon in the plane of x and y, and the walls that stand on its sides, infinitely high.
class Outline {
 public:
  /// @param corners  counter-clockwise, three or more, none between its neighbors [m]
  explicit Outline(const std::vector<Eigen::Vector2d>& corners);

  /// Returns whether the polygon has these corners, up to a tolerance [m].
  bool hasCorners(const std::vector<Eigen::Vector2d>& corners, double tolerance) const;

  const Eigen::AlignedBox2d& bounds() const { return bounds_; }

  /// Begins with a triangle, and keeps its part within the walls, boundary included.
  /// @returns whether something is left
  bool cut(const std::array<Eigen::Vector3d, 3>& triangle, PolygonCutter& part) const;

 private:
  struct Side {
    Eigen::Vector2d end;     // relative to the center
    Eigen::Vector2d normal;  // outward, unit
    double offset;
    double beyond(const Eigen::Vector2d& p) const { return normal.dot(p) - offset; }
  };

  Eigen::Vector2d fromCenter(const Eigen::Vector3d& p) const { return p.head<2>() - center_; }
  bool near(const Eigen::Vector3d& p) const { return fromCenter(p).squaredNorm() <= squared_inradius_; }
  bool isToward(size_t side, const Eigen::Vector2d& direction) const;
  size_t sideToward(const Eigen::Vector2d& direction) const;
  void cutAround(size_t side, PolygonCutter& part) const;

  Eigen::AlignedBox2d bounds_;
  Eigen::Vector2d center_ = Eigen::Vector2d::Zero();
  double squared_inradius_;                     // of a circle about the center within all walls
  std::vector<Side> sides_;                     // counter-clockwise
  std::array<size_t, 8> first_of_octant_ = {};  // side at which each octant about the center begins
};

}  // namespace sweep_guard_core
