#include "guard/out_of_reach.h"

#include <cmath>

#include "common/floating_point.h"

namespace sweep_guard_core {
bool staysBeside(const TriangleMesh& mesh_M, const Eigen::AlignedBox3d& points_M, double distance) {
  const double apart =
      (1.0 + kDistanceRounding) * distance + kDistanceRounding * (mesh_M.radius() + mesh_M.origin().norm());
  return points_M.squaredExteriorDistance(mesh_M.bounds_M()) > apart * apart;
}

bool staysOutOfReach(const Tool& tool, const PoseBounds& poses, const MovingMesh& mesh, double margin) {
  const double radius = 0.5 * tool.bounds_T().diagonal().norm();
  const double longest_chord = poses.point_M.diagonal().norm() + 2.0 * poses.deviation;
  const double growth = margin + mesh.spread() + poses.deviation;
  const double reach = 0.5 * longest_chord + mesh.translation_M().norm() + std::sqrt(3.0) * (radius + growth);
  return staysBeside(mesh.mesh_M(), poses.point_M, poses.deviation + reach);
}

}  // namespace sweep_guard_core
