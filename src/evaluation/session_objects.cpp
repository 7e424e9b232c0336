#include "evaluation/session_objects.h"

#include "evaluation/random.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::StampedPose;
using sweep_guard_core::TriangleMesh;

namespace {

constexpr double kMinHalfSide = 0.05;  // [m]
constexpr double kMaxHalfSide = 0.15;  // [m]

Eigen::AlignedBox3d workspaceOf(const RecordedMotion& motion) {
  Eigen::AlignedBox3d box_W;
  for (const StampedPose& pose : motion.poses()) box_W.extend(pose.X_WT.translation());
  return box_W;
}

Eigen::Isometry3d randomPose(const Eigen::AlignedBox3d& box_W, Random& random) {
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    X_WS.translation()[axis] = random.uniform(box_W.min()[axis], box_W.max()[axis]);
  }
  const double z = random.uniform(-1.0, 1.0);
  const double angle = random.uniform(0.0, 2.0 * kPi);
  const double radius = std::sqrt(1.0 - z * z);
  X_WS.linear() = random.frameWithZ({radius * std::cos(angle), radius * std::sin(angle), z});
  return X_WS;
}

TriangleMesh moved(const TriangleMesh& mesh_S, const Eigen::Isometry3d& X_WC) {
  const Eigen::Isometry3d X_WS = X_WC * Eigen::Translation3d(-mesh_S.bounds_M().center());
  std::vector<Eigen::Vector3d> vertices_W;
  for (size_t i = 0; i < mesh_S.vertexCount(); ++i) vertices_W.push_back(X_WS * mesh_S.vertex(i));
  return TriangleMesh(vertices_W, mesh_S.triangles());
}

}  // namespace

std::vector<TriangleMesh> placeInWorkspace(const RecordedMotion& motion, const SessionOptions& options,
                                           size_t session) {
  const Eigen::AlignedBox3d workspace_W = workspaceOf(motion);
  Random random(options.seed + session);
  std::vector<TriangleMesh> objects;
  for (size_t i = 0; i < options.sheets; ++i) {
    const double half_side = random.uniform(kMinHalfSide, kMaxHalfSide);
    objects.push_back(meshOf({randomPose(workspace_W, random), half_side}));
  }
  for (const TriangleMesh& mesh_S : options.placed) objects.push_back(moved(mesh_S, randomPose(workspace_W, random)));
  objects.insert(objects.end(), options.fixed.begin(), options.fixed.end());
  return objects;
}

}  // namespace sweep_guard_evaluation
