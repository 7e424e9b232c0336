#include "evaluation/session_objects.h"

#include "evaluation/random.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::TriangleMesh;

namespace {

constexpr double kMinHalfSide = 0.05;  // [m]
constexpr double kMaxHalfSide = 0.15;  // [m]
constexpr double kWorkspace = 0.2;     // [m] from where the tool was

/// Returns where the tool was at a random time without a gap.
Eigen::Vector3d randomPosition(const RecordedMotion& motion, Random& random) {
  Duration length{0};
  for (const auto& segment : motion.segments()) length += segment.end - segment.begin;
  Duration left = sweep_guard_core::fromSeconds(random.uniform(0.0, sweep_guard_core::toSeconds(length)));
  for (const auto& segment : motion.segments()) {
    if (left <= segment.end - segment.begin) return motion.at(segment.begin + left).translation();
    left -= segment.end - segment.begin;
  }
  return motion.poses().back().X_WT.translation();
}

Eigen::Isometry3d randomPose(const RecordedMotion& motion, Random& random) {
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  const double distance = kWorkspace * std::cbrt(random.uniform(0.0, 1.0));
  X_WS.translation() = randomPosition(motion, random) + distance * random.direction();
  X_WS.linear() = random.frameWithZ(random.direction());
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
  Random random(options.seed + session);
  std::vector<TriangleMesh> objects;
  for (size_t i = 0; i < options.sheets; ++i) {
    const double half_side = random.uniform(kMinHalfSide, kMaxHalfSide);
    objects.push_back(meshOf({randomPose(motion, random), half_side}));
  }
  for (const TriangleMesh& mesh_S : options.placed) objects.push_back(moved(mesh_S, randomPose(motion, random)));
  objects.insert(objects.end(), options.fixed.begin(), options.fixed.end());
  return objects;
}

}  // namespace sweep_guard_evaluation
