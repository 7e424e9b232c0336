#include "motion/plane_collector.h"

#include <algorithm>

#include "common/floating_point.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kSlack = 0.05;        // share of its gap by which a plane moves to the tool
constexpr double kMinSlack = 0x1p-17;  // of the mesh's radius: more than what float32 leaves in doubt
constexpr double kSameNormal = 0.9;    // cosine of the angle between normals in contact that one plane stands for

}  // namespace

void PlaneCollector::add(Facing& facing, const SeparatedTriangle& separated) {
  const TriangleMesh& mesh_M = facing.mesh();
  const double slack = separated.gap > 0.0 ? std::max(kSlack * separated.gap, kMinSlack * mesh_M.radius()) : 0.0;
  const double step = slack + mesh_M.rounding();
  const Eigen::Vector3d point_T = separated.top_T + step * separated.normal_T;
  const size_t number = planes_.size();
  if (separated.gap > 0.0) facing.cover.add(separated.normal_T, separated.normal_T.dot(point_T), number);
  const double drift = facing.surface->drift;
  planes_.push_back({{facing.piece, X_WT_.linear() * separated.normal_T, X_WT_ * (point_T + drift * separated.normal_T),
                      separated.gap - step - drift, -kInfinity},
                     facing.surface->workpiece,
                     separated.triangle,
                     separated.gap <= 0.0});
  quicken(number, facing, mesh_M.triangles()[separated.triangle]);
}

bool PlaneCollector::join(const Facing& facing, const SeparatedTriangle& separated) {
  ProximityPlane* const best = similar(facing, separated.normal_T);
  if (best == nullptr) return false;
  SeparatingPlane& plane = best->plane;
  const PointHull hull(facing.cover.corners_T(facing.corners(separated.triangle)));
  const Eigen::Vector3d top_W = X_WT_ * hull.supportPoint(normal_T(plane));
  const double step =
      std::max(0.0, plane.normal_W.dot(top_W - plane.point_W) + facing.mesh().rounding() + facing.surface->drift);
  moveOn(plane, step);
  quicken(static_cast<size_t>(best - planes_.data()), facing, facing.mesh().triangles()[separated.triangle]);
  return true;
}

ProximityPlane* PlaneCollector::similar(const Facing& facing, const Eigen::Vector3d& normal_T) const {
  const Eigen::Vector3d n_W = X_WT_.linear() * normal_T;
  ProximityPlane* best = nullptr;
  double cosine = kSameNormal;
  for (ProximityPlane& each : planes_) {
    const bool of_facing = each.workpiece == facing.surface->workpiece && each.plane.piece == facing.piece;
    if (!of_facing || !each.contact || !(each.plane.normal_W.dot(n_W) >= cosine)) continue;
    cosine = each.plane.normal_W.dot(n_W);
    best = &each;
  }
  return best;
}

}  // namespace sweep_guard_core
