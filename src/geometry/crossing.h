#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// Looks from a point p along +x at triangles of a surface. A closed surface, whose triangles are counter-clockwise
/// seen from outside, winds around p as many times as the sum of their crossings(). An edge on the ray counts with
/// exactly one of its triangles despite rounding, because both evaluate it from the same end.
/// @tparam Corner  function from the index of a vertex to its position relative to p [m]
template <typename Corner>
class View {
 public:
  explicit View(const Corner& corner) : corner_(corner) {}

  /// Returns 1 if the ray leaves a surface through the triangle, -1 if it enters, and 0 if it passes by.
  int crossing(const Triangle& triangle) const {
    const Eigen::Vector3d a = corner_(triangle[0]);
    const Eigen::Vector3d b = corner_(triangle[1]);
    const Eigen::Vector3d c = corner_(triangle[2]);
    if (std::max({a.y(), b.y(), c.y()}) < 0.0 || std::min({a.y(), b.y(), c.y()}) > 0.0) return 0;
    if (std::max({a.z(), b.z(), c.z()}) < 0.0 || std::min({a.z(), b.z(), c.z()}) > 0.0) return 0;
    const int side = sideOf(triangle);
    return side * a.dot(b.cross(c)) > 0.0 ? side : 0;
  }

  int crossings(const Triangle* begin, const Triangle* end) const {
    int sum = 0;
    for (; begin != end; ++begin) sum += crossing(*begin);
    return sum;
  }

  /// Returns the solid angle [sr] of a triangle, in [-2 pi, 2 pi]: positive if its corners are clockwise seen from p.
  /// [van Oosterom 1983]. In its plane it has the sign that fits crossing().
  double solidAngle(const Triangle& triangle) const {
    const Eigen::Vector3d a = corner_(triangle[0]);
    const Eigen::Vector3d b = corner_(triangle[1]);
    const Eigen::Vector3d c = corner_(triangle[2]);
    double volume = a.dot(b.cross(c));
    if (volume == 0.0) volume = std::copysign(0.0, besidePlane(triangle, (b - a).cross(c - a)));
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    return 2.0 * std::atan2(volume, la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }

 private:
  // Returns on which side of all three edges the ray passes, +1 or -1, or 0 if it does not pass through the triangle.
  int sideOf(const Triangle& triangle) const {
    const int side = sideOf(triangle[0], triangle[1]);
    return side == sideOf(triangle[1], triangle[2]) && side == sideOf(triangle[2], triangle[0]) ? side : 0;
  }

  // A ray through the edge counts as shifted by (e, e^2) in y and z, for an infinitesimal e.
  int sideOf(std::uint32_t from, std::uint32_t to) const {
    if (from > to) return -sideOf(to, from);
    const Eigen::Vector3d a = corner_(from);
    const Eigen::Vector3d b = corner_(to);
    for (const double turn : {a.y() * b.z() - a.z() * b.y(), a.z() - b.z(), b.y() - a.y()}) {
      if (turn != 0.0) return turn > 0.0 ? 1 : -1;
    }
    return 1;
  }

  // Of a point in the plane of a triangle, which crossing() takes for one that has passed it.
  double besidePlane(const Triangle& triangle, const Eigen::Vector3d& normal) const {
    if (const int side = sideOf(triangle); side != 0) return -side;
    return normal.y() != 0.0 ? -normal.y() : -normal.z();
  }

  const Corner& corner_;
};

}  // namespace sweep_guard_core
