#include "guard/swept_body.h"

#include <algorithm>

#include "common/heartbeat.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

// The convex hull of a body at both ends of a motion, relative to a nearby origin.
class HullOfMotion {
 public:
  HullOfMotion(const ConvexShape& shape_T, const Motion& motion, const Eigen::Vector3d& origin)
      : shape_T_(shape_T), motion_(motion), origin_(origin) {}

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d at_start = supportAt(motion_.X_MT_start, direction);
    const Eigen::Vector3d at_end = supportAt(motion_.X_MT_end, direction);
    const Eigen::Vector3d& p = direction.dot(at_end - at_start) > 0.0 ? at_end : at_start;
    return direction.dot(motion_.mesh_translation) > 0.0 ? Eigen::Vector3d(p + motion_.mesh_translation) : p;
  }

 private:
  Eigen::Vector3d supportAt(const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction) const {
    return X_MT.linear() * shape_T_.supportPoint(X_MT.linear().transpose() * direction) +
           (X_MT.translation() - origin_);
  }

  const ConvexShape& shape_T_;
  const Motion& motion_;
  Eigen::Vector3d origin_;
};

}  // namespace

SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin) {
  return {&shape_T, motion_M, kind, sweptVolume(shape_T, motion_M, kind, margin)};
}

bool missedByHull(const ConvexShape& shape_T, const Motion& motion_M, const MovingTriangle& triangle, double margin,
                  const Eigen::Vector3d& guess_M) {
  const Eigen::Vector3d& origin = triangle.end_M[0];
  const HullOfMotion hull(shape_T, motion_M, origin);
  PointHull prism;
  for (const Eigen::Vector3d& p : triangle.end_M) prism.add(p - origin);
  if (triangle.start_M != triangle.end_M) {
    for (const Eigen::Vector3d& p : triangle.start_M) prism.add(p - origin);
  }
  return distanceExceeds(hull, prism, margin, guess_M);
}

bool misses(const SweptBody& body, const TriangleMesh& mesh_M, std::uint32_t triangle, double growth) {
  beat();
  return missedByHull(*body.shape_T, body.motion_M, MovingMesh(mesh_M).triangle(triangle),
                      body.volume_M.margin + growth);
}

void removeMissedByHull(const SweptBody& body, const TriangleMesh& mesh_M, Detection& detection) {
  if (body.kind != VolumeKind::kHull) return;
  TriangleSet& triangles = detection.triangles;
  const auto is_missed = [&](std::uint32_t triangle) { return misses(body, mesh_M, triangle, detection.inflation); };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), is_missed), triangles.end());
}

}  // namespace sweep_guard_core
