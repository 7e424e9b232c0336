#include "evaluation/sheet.h"

#include <algorithm>

#include "sweep_guard/geometry/half_space.h"

namespace sweep_guard_evaluation {

using sweep_guard::ConvexShape;
using sweep_guard::HalfSpace;
using sweep_guard::Polygon;

namespace {

Polygon cornersOf(const Sheet& sheet, const Eigen::Isometry3d& X_FS) {
  const double h = sheet.half_side;
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

bool comesNearAxis(const Polygon& polygon, double radius) {
  bool left = true;
  bool right = true;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i].head<2>();
    const Eigen::Vector2d b = polygon[(i + 1) % polygon.size()].head<2>();
    if (distanceToSegment(a, b) <= radius) return true;
    left = left && cross(a, b) > 0.0;
    right = right && cross(a, b) < 0.0;
  }
  return !polygon.empty() && (left || right);  // the axis goes through the polygon's inside
}

}  // namespace

sweep_guard::TriangleMesh meshOf(const Sheet& sheet) {
  return sweep_guard::TriangleMesh(cornersOf(sheet, sheet.X_WS), {{0, 1, 2}, {0, 2, 3}});
}

bool meets(const ConvexShape& tool, const Eigen::Isometry3d& X_WT, const Sheet& sheet, double margin) {
  Polygon part_T = cornersOf(sheet, X_WT.inverse() * sheet.X_WS);
  part_T = clip(part_T, HalfSpace(Eigen::Vector3d::UnitZ(), margin));
  part_T = clip(part_T, HalfSpace(-Eigen::Vector3d::UnitZ(), tool.length() + margin));
  return comesNearAxis(part_T, tool.radius() + margin);
}

}  // namespace sweep_guard_evaluation
