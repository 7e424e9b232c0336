#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

// Looks from a point p along +x at triangles of a surface. A closed surface, whose triangles are counter-clockwise
// seen from outside, winds around p as many times as the sum of their crossings(). An edge on the ray counts with
// exactly one of its triangles despite rounding: seen from its other end, each turn is the negative bit for bit, as no
// product is contracted with a sum (-ffp-contract=off). `corner` is a function from the index of a vertex to its position
// relative to p [m].

/// Returns on which side of an edge the ray passes, +1 or -1. One through the edge counts as shifted by (e, e^2) in y and z, for
/// an infinitesimal e.
template <typename Corner>
int sideOf(const Corner& corner, std::uint32_t from, std::uint32_t to) {
  const Eigen::Vector3d a = corner(from);
  const Eigen::Vector3d b = corner(to);
  for (const double turn : {a.y() * b.z() - a.z() * b.y(), a.z() - b.z(), b.y() - a.y()}) {
    if (turn != 0.0) return turn > 0.0 ? 1 : -1;
  }
  return 1;
}

/// Returns on which side of all three edges the ray passes, or 0 if it does not pass through the triangle.
template <typename Corner>
int sideOf(const Corner& corner, const Triangle& triangle) {
  const int side = sideOf(corner, triangle[0], triangle[1]);
  const bool same =
      side == sideOf(corner, triangle[1], triangle[2]) && side == sideOf(corner, triangle[2], triangle[0]);
  return same ? side : 0;
}

/// Returns 1 if the ray leaves a surface through the triangle, -1 if it enters, and 0 if it passes by.
template <typename Corner>
int crossing(const Corner& corner, const Triangle& triangle) {
  const Eigen::Vector3d a = corner(triangle[0]);
  const Eigen::Vector3d b = corner(triangle[1]);
  const Eigen::Vector3d c = corner(triangle[2]);
  if (std::max({a.y(), b.y(), c.y()}) < 0.0 || std::min({a.y(), b.y(), c.y()}) > 0.0) return 0;
  if (std::max({a.z(), b.z(), c.z()}) < 0.0 || std::min({a.z(), b.z(), c.z()}) > 0.0) return 0;
  const int side = sideOf(corner, triangle);
  return side * a.dot(b.cross(c)) > 0.0 ? side : 0;
}

template <typename Corner>
int crossings(const Corner& corner, const Triangle* begin, const Triangle* end) {
  int sum = 0;
  for (; begin != end; ++begin) sum += crossing(corner, *begin);
  return sum;
}

/// Returns the solid angle [sr] of a triangle, in [-2 pi, 2 pi]: positive if its corners are clockwise seen from p.
/// [van Oosterom 1983]. In its plane, where crossing() takes p for one that has passed it, it has the sign that fits.
template <typename Corner>
double solidAngle(const Corner& corner, const Triangle& triangle) {
  const Eigen::Vector3d a = corner(triangle[0]);
  const Eigen::Vector3d b = corner(triangle[1]);
  const Eigen::Vector3d c = corner(triangle[2]);
  double volume = a.dot(b.cross(c));
  if (volume == 0.0) {
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    const int side = sideOf(corner, triangle);
    const double across = normal.y() != 0.0 ? -normal.y() : -normal.z();
    volume = std::copysign(0.0, side != 0 ? -side : across);
  }
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2.0 * std::atan2(volume, la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace sweep_guard_core
