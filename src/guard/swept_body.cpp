#include "guard/swept_body.h"

#include <algorithm>

#include "common/heartbeat.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin) {
  return {&shape_T, motion_M, kind, sweptVolume(shape_T, motion_M, kind, margin)};
}

bool missedByHull(const ConvexShape& shape_T, const Motion& motion_M, const MovingTriangle& triangle, double margin,
                  const Eigen::Vector3d& guess_M) {
  const Eigen::Vector3d& origin = triangle.end_M[0];
  const auto supportAt = [&](const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction) -> Eigen::Vector3d {
    return X_MT.linear() * shape_T.supportPoint(X_MT.linear().transpose() * direction) + (X_MT.translation() - origin);
  };
  // The convex hull of the body at both ends of the motion, relative to the origin.
  const auto hull = [&](const Eigen::Vector3d& direction) -> Eigen::Vector3d {
    const Eigen::Vector3d at_start = supportAt(motion_M.X_MT_start, direction);
    const Eigen::Vector3d at_end = supportAt(motion_M.X_MT_end, direction);
    const Eigen::Vector3d& p = direction.dot(at_end - at_start) > 0.0 ? at_end : at_start;
    return direction.dot(motion_M.mesh_translation) > 0.0 ? Eigen::Vector3d(p + motion_M.mesh_translation) : p;
  };
  PointHull prism;
  for (const Eigen::Vector3d& p : triangle.end_M) prism.add(p - origin);
  if (triangle.start_M != triangle.end_M) {
    for (const Eigen::Vector3d& p : triangle.start_M) prism.add(p - origin);
  }
  return distanceExceeds(hull, prism, margin, guess_M);
}

bool misses(const SweptBody& body, const MovingTriangle& triangle, double growth) {
  beat();
  return missedByHull(*body.shape_T, body.motion_M, triangle, body.volume_M.margin + growth);
}

void removeMissedByHull(const SweptBody& body, const MovingMesh& mesh, Detection& detection) {
  if (body.kind != VolumeKind::kHull) return;
  TriangleSet& triangles = detection.triangles;
  const auto is_missed = [&](std::uint32_t triangle) {
    return misses(body, mesh.untranslated(triangle), detection.inflation);
  };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_missed), triangles.end());
}

}  // namespace sweep_guard_core
