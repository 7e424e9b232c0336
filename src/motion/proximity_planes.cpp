#include "motion/proximity_planes.h"

#include <algorithm>

#include "common/floating_point.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kSlack = 0.05;        // share of its gap by which a plane moves to the tool
constexpr double kMinSlack = 0x1p-17;  // of the mesh's radius: more than what float32 leaves in doubt
constexpr double kSameNormal = 0.9;    // cosine of the angle between normals in contact that one plane stands for

ProximityPlane* similarPlane(const Facing& facing, const Eigen::Vector3d& n_W, std::vector<ProximityPlane>& planes) {
  ProximityPlane* best = nullptr;
  double cosine = kSameNormal;
  for (ProximityPlane& each : planes) {
    const bool of_facing = each.workpiece == facing.surface->workpiece && each.plane.piece == facing.pieceOfTool();
    if (!of_facing || !each.contact || !(each.plane.normal_W.dot(n_W) >= cosine)) continue;
    cosine = each.plane.normal_W.dot(n_W);
    best = &each;
  }
  return best;
}

}  // namespace

void addFacingPlane(Facing& facing, const SeparatedTriangle& separated, std::vector<ProximityPlane>& planes) {
  const Eigen::Isometry3d& X_WT = facing.body->X_WT;
  const TriangleMesh& mesh_M = facing.mesh();
  const double slack = separated.gap > 0.0 ? std::max(kSlack * separated.gap, kMinSlack * mesh_M.radius()) : 0.0;
  const double step = slack + mesh_M.margin();
  const Eigen::Vector3d point_T = separated.top_T + step * separated.normal_T;
  const double behind =
      separated.normal_T.dot(separated.top_T) + slack;  // the rest of what it stands for has a margin, too
  if (separated.gap > 0.0) facing.cover.add(separated.normal_T, behind, planes.size());
  const double drift = facing.surface->drift;
  planes.push_back({{facing.pieceOfTool(), X_WT.linear() * separated.normal_T,
                     X_WT * (point_T + drift * separated.normal_T), separated.gap - step - drift, -kInfinity},
                    facing.surface->workpiece,
                    separated.triangle,
                    separated.gap <= 0.0});
  quicken(planes.back().plane, facing, mesh_M.triangles()[separated.triangle]);
}

bool joinFacingPlane(const Facing& facing, const SeparatedTriangle& separated, std::vector<ProximityPlane>& planes) {
  const Eigen::Isometry3d& X_WT = facing.body->X_WT;
  ProximityPlane* const best = similarPlane(facing, X_WT.linear() * separated.normal_T, planes);
  if (best == nullptr) return false;
  SeparatingPlane& plane = best->plane;
  const PointHull hull(facing.cover.corners_T(facing.corners(separated.triangle)));
  const Eigen::Vector3d top_W = X_WT * hull.supportPoint(X_WT.linear().transpose() * plane.normal_W);
  const double step =
      std::max(0.0, plane.normal_W.dot(top_W - plane.point_W) + facing.mesh().margin() + facing.surface->drift);
  moveOn(plane, step);
  quicken(plane, facing, facing.mesh().triangles()[separated.triangle]);
  return true;
}

}  // namespace sweep_guard_core
