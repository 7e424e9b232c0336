#include "evaluation/obstacle_mesh.h"

#include <algorithm>

#include "detection/inside.h"
#include "evaluation/square_obstacle.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_evaluation {

namespace {

constexpr double kAccuracy = 1e-5;  // [m]

}  // namespace

ObstacleMesh::ObstacleMesh(const sweep_guard_core::ConvexShape& tool, const sweep_guard_core::TriangleMesh& mesh_W)
    : tool_(tool), mesh_W_(mesh_W), bounds_W_(mesh_W.bounds_M()) {}

ClearanceAt ObstacleMesh::clearance() {
  return clearanceFrom(tool_, bounds_W_.center(), 0.5 * bounds_W_.diagonal().norm(),
                       [this](const Eigen::Isometry3d& X_WT, double margin) { return intersects(X_WT, margin); });
}

bool ObstacleMesh::tipInside(const Eigen::Isometry3d& X_WT) const {
  return mesh_W_.closed() && bounds_W_.contains(X_WT.translation()) &&
         sweep_guard_core::inside(mesh_W_, X_WT.translation());
}

// Calls the function with the corners, in T, of triangles near the tool until it returns false.
template <typename Function>
void ObstacleMesh::forEachTriangleWithin(double margin, const Eigen::Isometry3d& X_WT, const Function& function) {
  const Eigen::Vector3d tip = X_WT.translation();
  const Eigen::Vector3d rear = X_WT * Eigen::Vector3d(0.0, 0.0, -tool_.length());
  Eigen::AlignedBox3d box_W(tip.cwiseMin(rear), tip.cwiseMax(rear));
  const double grown = tool_.radius() + margin;
  box_W = {box_W.min().array() - grown, box_W.max().array() + grown};
  if (!box_W.intersects(bounds_W_)) return;
  const Eigen::Isometry3d X_TW = X_WT.inverse();
  bool more = true;
  finder_.find(mesh_W_, box_W).forEachTriangle([&](std::uint32_t triangle) {
    if (!more) return;
    const auto& [a, b, c] = mesh_W_.triangles()[triangle];
    more = function(Corners{X_TW * mesh_W_.vertex(a), X_TW * mesh_W_.vertex(b), X_TW * mesh_W_.vertex(c)});
  });
}

bool ObstacleMesh::intersects(const Eigen::Isometry3d& X_WT, double margin) {
  bool met = false;
  forEachTriangleWithin(margin, X_WT, [&](const Corners& corners_T) {
    met = sweep_guard_evaluation::intersects(tool_, {corners_T.begin(), corners_T.end()}, margin);
    return !met;
  });
  return met || tipInside(X_WT);
}

double ObstacleMesh::distance(const Eigen::Isometry3d& X_WT) {
  const double bound = bounds_W_.exteriorDistance(X_WT.translation()) - tool_.boundingRadius();
  if (bound > kExactDistance) return bound;
  if (tipInside(X_WT)) return 0.0;
  double nearest = kExactDistance;
  forEachTriangleWithin(kExactDistance, X_WT, [&](const Corners& corners_T) {
    const sweep_guard_core::PointHull triangle(corners_T);
    nearest = std::min(nearest, sweep_guard_core::separation(tool_, triangle, kAccuracy).gap);
    return nearest > 0.0;
  });
  return std::max(0.0, nearest);
}

}  // namespace sweep_guard_evaluation
