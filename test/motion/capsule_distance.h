#pragma once

// The distance of a capsule from triangles by formulas of its own, apart from what is tested.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace sweep_guard_core {

/// The points within `radius` of a segment.
struct Capsule {
  Eigen::Vector3d from;  ///< [m]
  Eigen::Vector3d to;    ///< [m]
  double radius;         ///< [m]
};

/// The points of a segment and of a surface that are nearest to each other.
struct NearestPair {
  Eigen::Vector3d on_segment = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_surface = Eigen::Vector3d::Zero();
  double distance = std::numeric_limits<double>::infinity();

  void take(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const double apart = (p - q).norm();
    if (apart < distance) *this = {p, q, apart};
  }
};

/// Takes the nearest points of two segments: of each, the one nearest to the line of the other, then clamped in turn.
inline void takeSegments(const Capsule& segment, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         NearestPair& nearest) {
  const Eigen::Vector3d along = segment.to - segment.from;
  const Eigen::Vector3d edge = b - a;
  const Eigen::Vector3d between = segment.from - a;
  const double uu = along.squaredNorm();
  const double vv = edge.squaredNorm();
  const double uv = along.dot(edge);
  const auto unit = [](double value) { return std::clamp(value, 0.0, 1.0); };
  const auto onEdge = [&](double s) { return vv > 0.0 ? unit(edge.dot(between + s * along) / vv) : 0.0; };
  const auto onSegment = [&](double t) { return uu > 0.0 ? unit(along.dot(t * edge - between) / uu) : 0.0; };
  const double cross = uu * vv - uv * uv;
  const double inner = cross > 0.0 ? unit((uv * edge.dot(between) - vv * along.dot(between)) / cross) : 0.0;
  for (const double start : {inner, 0.0, 1.0}) {
    const double t = onEdge(start);
    const double s = onSegment(t);
    nearest.take(segment.from + s * along, a + onEdge(s) * edge);
  }
}

inline void takeTriangle(const Capsule& segment, const std::array<Eigen::Vector3d, 3>& corners, NearestPair& nearest) {
  const Eigen::Vector3d &a = corners[0], &b = corners[1], &c = corners[2];
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  const auto inside = [&](const Eigen::Vector3d& p) {
    return normal.dot((b - a).cross(p - a)) >= 0.0 && normal.dot((c - b).cross(p - b)) >= 0.0 &&
           normal.dot((a - c).cross(p - c)) >= 0.0;
  };
  const double from = normal.dot(segment.from - a);
  const double to = normal.dot(segment.to - a);
  if (inside(segment.from - from * normal)) nearest.take(segment.from, segment.from - from * normal);
  if (inside(segment.to - to * normal)) nearest.take(segment.to, segment.to - to * normal);
  if (from * to < 0.0) {
    const Eigen::Vector3d through = segment.from + from / (from - to) * (segment.to - segment.from);
    if (inside(through)) nearest.take(through, through);
  }
  takeSegments(segment, a, b, nearest);
  takeSegments(segment, b, c, nearest);
  takeSegments(segment, c, a, nearest);
}

}  // namespace sweep_guard_core
