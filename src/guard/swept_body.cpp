#include "sweep_guard/guard/swept_body.h"

#include <algorithm>
#include <array>

#include "sweep_guard/geometry/separation.h"

namespace sweep_guard {
namespace {

// The convex hull of a body at both ends of a motion, seen from a place near it.
class HullOfMotion {
 public:
  HullOfMotion(const ConvexShape& shape_T, const Motion& motion, const Eigen::Vector3d& place)
      : shape_T_(shape_T), motion_(motion), place_(place) {}

  Eigen::Vector3d operator()(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d at_start = farthest(motion_.X_MT_start, direction);
    const Eigen::Vector3d at_end = farthest(motion_.X_MT_end, direction);
    const Eigen::Vector3d& p = direction.dot(at_end - at_start) > 0.0 ? at_end : at_start;
    return direction.dot(motion_.drift) > 0.0 ? Eigen::Vector3d(p + motion_.drift) : p;
  }

 private:
  Eigen::Vector3d farthest(const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction) const {
    return X_MT.linear() * shape_T_.supportPoint(X_MT.linear().transpose() * direction) + (X_MT.translation() - place_);
  }

  const ConvexShape& shape_T_;
  const Motion& motion_;
  Eigen::Vector3d place_;
};

// Without those that a direction proves to be farther from the hull than the margin.
TriangleSet metByHull(const TriangleMesh& mesh_M, const SweptBody& body, double margin, const TriangleSet& triangles) {
  TriangleSet met;
  for (const std::uint32_t triangle : triangles) {
    const auto& [a, b, c] = mesh_M.triangles()[triangle];
    const Eigen::Vector3d& place = mesh_M.origin();
    const Eigen::Vector3d near = mesh_M.offset(a);
    const HullOfMotion hull(*body.shape_T, body.motion_M, place + near);
    const PointHull corners(
        std::array<Eigen::Vector3d, 3>{Eigen::Vector3d::Zero(), mesh_M.offset(b) - near, mesh_M.offset(c) - near});
    if (!fartherApart(hull, corners, margin)) met.push_back(triangle);
  }
  return met;
}

}  // namespace

SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin) {
  return {&shape_T, motion_M, kind, sweptVolume(shape_T, motion_M, kind, margin)};
}

Detection detect(Detector& detector, const TriangleMesh& mesh_M, const SweptBody& body, const TriangleSet* among) {
  Detection detection =
      among == nullptr ? detector.detect(mesh_M, body.volume_M) : detector.detectAmong(mesh_M, body.volume_M, *among);
  if (body.kind == VolumeKind::kHull) {
    const double margin = body.volume_M.margin + detection.inflation;
    detection.triangles = metByHull(mesh_M, body, margin, detection.triangles);
  }
  return detection;
}

}  // namespace sweep_guard
