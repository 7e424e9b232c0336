#include "guard/out_of_reach.h"

#include <algorithm>
#include <cmath>

#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_core {
namespace {

constexpr double kMinSigma = 2e-9;  // [m]; planeDeviations() are at least 1e-9 along each of three axes

template <typename Measure>
double larger(const UncertainPose& begin, const UncertainPose& end, const Measure& measure) {
  return std::max(measure(begin.covariance_M), measure(end.covariance_M));
}

}  // namespace

// Each of these is convex in the covariance, so that between the poses none is larger than at both.
UncertainStep::UncertainStep(const UncertainPose& begin, const UncertainPose& end, double margin)
    : begin_M_(begin.X_MT),
      end_M_(end.X_MT),
      angle_(Motion{begin.X_MT, end.X_MT}.angle()),
      margin_(margin),
      moves_(larger(begin, end, [](const Matrix6d& C) { return C.topLeftCorner<3, 3>().trace(); })),
      turns_(larger(begin, end, [](const Matrix6d& C) { return C.bottomRightCorner<3, 3>().trace(); })),
      both_(larger(begin, end, [](const Matrix6d& C) { return C.topRightCorner<3, 3>().norm(); })),
      turns_norm_(larger(begin, end, [](const Matrix6d& C) { return C.bottomRightCorner<3, 3>().norm(); })) {}

// Of the pieces' center at r from the origin, the variances along the three axes add up to the trace of the covariance of dx +
// dtheta x r. Of a point beside it by d, the deviation along an axis differs by at most that of dtheta x d.
UncertainBall UncertainStep::ballAround(const Eigen::AlignedBox3d& pieces_T) const {
  const Eigen::Vector3d center_T = pieces_T.center();
  const Eigen::Vector3d sides = pieces_T.sizes();
  const double r = center_T.norm();
  const Eigen::Vector3d from = begin_M_ * center_T;
  const Eigen::Vector3d to = end_M_ * center_T;
  const Eigen::Vector3d middle = 0.5 * (from + to);
  const double reach = 0.5 * sides.sum() * (1.0 + angle_) + 0.5 * (to - from).norm() + std::sqrt(3.0) * margin_;
  const double trace = moves_ + r * r * turns_ + 2.0 * std::sqrt(2.0) * r * both_;
  const double sigma = std::sqrt(trace) + std::sqrt(3.0 * turns_norm_) * 0.5 * sides.norm();
  return {middle, reach + kDistanceRounding * (middle.norm() + reach), sigma + kMinSigma};
}

bool staysBeside(const Submesh& submesh, const Eigen::AlignedBox3d& points_M, double distance) {
  const TriangleMesh& mesh_M = submesh.mesh_M();
  const double apart =
      (1.0 + kDistanceRounding) * distance + kDistanceRounding * (mesh_M.radius() + mesh_M.origin().norm());
  const Eigen::AlignedBox3d& bounds = submesh.bounds();
  const Eigen::AlignedBox3d bounds_M(mesh_M.origin() + bounds.min(), mesh_M.origin() + bounds.max());
  return points_M.squaredExteriorDistance(bounds_M) > apart * apart;
}

bool staysOutOfReach(const Tool& tool, const PoseBounds& poses, const MovingMesh& mesh, double margin) {
  const double radius = 0.5 * tool.bounds_T().diagonal().norm();
  const double longest_chord = poses.point_M.diagonal().norm() + 2.0 * poses.deviation;
  const double growth = margin + mesh.spread() + poses.deviation;
  const double reach = 0.5 * longest_chord + mesh.translation_M().norm() + std::sqrt(3.0) * (radius + growth);
  return staysBeside(mesh.submesh(), poses.point_M, poses.deviation + reach);
}

}  // namespace sweep_guard_core
