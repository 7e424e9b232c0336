#include "sweep_guard/guard/swept_body.h"

#include <algorithm>

#include "sweep_guard/geometry/separation.h"
#include "sweep_guard/guard/moving_mesh.h"

namespace sweep_guard_core {
namespace {

// The convex hull of a body at both ends of a motion, seen from a place near it.
class HullOfMotion {
 public:
  HullOfMotion(const ConvexShape& shape_T, const Motion& motion, const Eigen::Vector3d& place)
      : shape_T_(shape_T), motion_(motion), place_(place) {}

  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d at_start = farthest(motion_.X_MT_start, direction);
    const Eigen::Vector3d at_end = farthest(motion_.X_MT_end, direction);
    const Eigen::Vector3d& p = direction.dot(at_end - at_start) > 0.0 ? at_end : at_start;
    return direction.dot(motion_.mesh_translation) > 0.0 ? Eigen::Vector3d(p + motion_.mesh_translation) : p;
  }

 private:
  Eigen::Vector3d farthest(const Eigen::Isometry3d& X_MT, const Eigen::Vector3d& direction) const {
    return X_MT.linear() * shape_T_.supportPoint(X_MT.linear().transpose() * direction) + (X_MT.translation() - place_);
  }

  const ConvexShape& shape_T_;
  const Motion& motion_;
  Eigen::Vector3d place_;
};

}  // namespace

SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin) {
  return {&shape_T, motion_M, kind, sweptVolume(shape_T, motion_M, kind, margin)};
}

bool missedByHull(const ConvexShape& shape_T, const Motion& motion_M, const MovingTriangle& triangle, double margin) {
  const Eigen::Vector3d& place = triangle.end_M[0];
  const HullOfMotion hull(shape_T, motion_M, place);
  PointHull prism;
  for (const Eigen::Vector3d& p : triangle.end_M) prism.add(p - place);
  if (triangle.start_M != triangle.end_M) {
    for (const Eigen::Vector3d& p : triangle.start_M) prism.add(p - place);
  }
  return distanceExceeds(hull, prism, margin);
}

void detect(Detector& detector, const Submesh& part, const SweptBody& body, Detection& found) {
  found = detector.detect(part, body.volume_M);
  if (body.kind != VolumeKind::kHull) return;
  const double margin = body.volume_M.margin + found.inflation;
  const MovingMesh resting(part.mesh_M());
  const auto missed = [&](std::uint32_t triangle) {
    return missedByHull(*body.shape_T, body.motion_M, resting.triangle(triangle), margin);
  };
  std::vector<std::uint32_t>& left = found.triangles;
  left.erase(std::remove_if(left.begin(), left.end(), missed), left.end());
}

}  // namespace sweep_guard_core
