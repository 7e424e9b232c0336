#include "evaluation/square_obstacle.h"

#include <algorithm>

namespace sweep_guard_evaluation {

using sweep_guard_core::ConvexShape;
using sweep_guard_core::HalfSpace;
using sweep_guard_core::Polygon;

namespace {

Polygon cornersOf(const SquareObstacle& obstacle, const Eigen::Isometry3d& X_FS) {
  const double h = obstacle.half_side;
  Polygon corners = {{-h, -h, 0.0}, {h, -h, 0.0}, {h, h, 0.0}, {-h, h, 0.0}};
  for (Eigen::Vector3d& corner : corners) corner = X_FS * corner;
  return corners;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double distanceToSegment(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length = along.squaredNorm();
  const double fraction = length > 0.0 ? std::clamp(-a.dot(along) / length, 0.0, 1.0) : 0.0;
  return (a + fraction * along).norm();
}

bool isNearAxis(const Polygon& polygon, double radius) {
  bool left = true;
  bool right = true;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i].head<2>();
    const Eigen::Vector2d b = polygon[(i + 1) % polygon.size()].head<2>();
    if (distanceToSegment(a, b) <= radius) return true;
    left = left && cross(a, b) > 0.0;
    right = right && cross(a, b) < 0.0;
  }
  return !polygon.empty() && (left || right);  // the axis passes through the polygon
}

}  // namespace

sweep_guard_core::TriangleMesh meshOf(const SquareObstacle& obstacle) {
  return sweep_guard_core::TriangleMesh(cornersOf(obstacle, obstacle.X_WS), {{0, 1, 2}, {0, 2, 3}});
}

bool intersects(const ConvexShape& tool, Polygon polygon_T, double margin) {
  polygon_T = clip(polygon_T, HalfSpace(Eigen::Vector3d::UnitZ(), margin));
  polygon_T = clip(polygon_T, HalfSpace(-Eigen::Vector3d::UnitZ(), tool.length() + margin));
  return isNearAxis(polygon_T, tool.radius() + margin);
}

bool intersects(const ConvexShape& tool, const Eigen::Isometry3d& X_WT, const SquareObstacle& obstacle, double margin) {
  return intersects(tool, cornersOf(obstacle, X_WT.inverse() * obstacle.X_WS), margin);
}

}  // namespace sweep_guard_evaluation
