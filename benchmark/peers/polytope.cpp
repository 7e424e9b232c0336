#include "peers/polytope.h"

#include <algorithm>

#include "sweep_guard/geometry/half_space.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_benchmark {
namespace {

constexpr double kSameCorner = 1e-9;  // [m]

Point toPoint(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

int indexOf(const Eigen::Vector3d& corner, std::vector<Eigen::Vector3d>& corners) {
  const auto same = [&](const Eigen::Vector3d& other) { return (other - corner).norm() < kSameCorner; };
  const auto found = std::find_if(corners.begin(), corners.end(), same);
  if (found != corners.end()) return static_cast<int>(found - corners.begin());
  corners.push_back(corner);
  return static_cast<int>(corners.size()) - 1;
}

}  // namespace

Polytope polytope(const sweep_guard_core::SweptVolume& swept_M, const sweep_guard_core::Motion& motion_M) {
  const Eigen::Isometry3d& X_MB = swept_M.box.X_MB;
  Polytope polytope_M;
  polytope_M.swept_M = &swept_M;
  polytope_M.motion_M = &motion_M;
  const std::vector<sweep_guard_core::HalfSpace> half_spaces_B = swept_M.halfSpaces_B();
  for (const sweep_guard_core::HalfSpace& half_space_B : half_spaces_B) {
    const Eigen::Vector3d normal_M = X_MB.linear() * half_space_B.normal();
    polytope_M.planes_M.push_back({toPoint(normal_M), half_space_B.offset() + normal_M.dot(X_MB.translation())});
  }
  std::vector<Eigen::Vector3d> corners_B;
  for (const sweep_guard_core::Polygon& face : polytopeFaces(half_spaces_B, 1.01 * swept_M.box.half_extents.norm())) {
    std::vector<int> indices;
    for (const Eigen::Vector3d& corner : face) {
      const int index = indexOf(corner, corners_B);
      if (std::find(indices.begin(), indices.end(), index) == indices.end()) indices.push_back(index);
    }
    if (indices.size() >= 3) polytope_M.faces.push_back(indices);
  }
  Eigen::AlignedBox3d box_M;
  for (const Eigen::Vector3d& corner_B : corners_B) {
    const Eigen::Vector3d corner_M = X_MB * corner_B;
    polytope_M.corners_M.push_back(toPoint(corner_M));
    box_M.extend(corner_M);
  }
  polytope_M.lower_M = toPoint(box_M.min());
  polytope_M.upper_M = toPoint(box_M.max());
  return polytope_M;
}

}  // namespace sweep_guard_benchmark
