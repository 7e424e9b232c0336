#include "sweep_guard/geometry/oriented_box.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>

namespace sweep_guard_core {
namespace {

// The sums of [P, Sec. 3.1] over both poses follow from those over one body: moments of a union of equal sets. A
// mesh_translation doubles the sets once more.
Eigen::Matrix3d covarianceOfBoth(const Moments& moments_T, const Motion& motion) {
  const Eigen::Matrix3d& R_start = motion.X_MT_start.linear();
  const Eigen::Matrix3d& R_end = motion.X_MT_end.linear();
  const Eigen::Vector3d half_step = 0.5 * (motion.X_MT_end * moments_T.mean - motion.X_MT_start * moments_T.mean);
  return 0.5 *
             (R_start * moments_T.covariance * R_start.transpose() + R_end * moments_T.covariance * R_end.transpose()) +
         half_step * half_step.transpose() + 0.25 * motion.mesh_translation * motion.mesh_translation.transpose();
}

struct Axis {
  Eigen::Vector3d direction_M;
  double lower;
  double upper;
  double halfExtent() const { return 0.5 * (upper - lower); }
  double center() const { return 0.5 * (upper + lower); }
};

}  // namespace

OrientedBox boundingBox(const ConvexShape& shape, const Motion& motion) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covarianceOfBoth(shape.moments_T(), motion));
  assert(solver.info() == Eigen::Success);

  std::array<Axis, 3> axes;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d direction = solver.eigenvectors().col(i);
    axes[static_cast<size_t>(i)] = {direction, -support(shape, motion, -direction), support(shape, motion, direction)};
  }
  std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.halfExtent() < b.halfExtent(); });

  OrientedBox box;
  for (int i = 0; i < 3; ++i) {
    const Axis& axis = axes[static_cast<size_t>(i)];
    box.X_MB.linear().col(i) = axis.direction_M;
    box.X_MB.translation() += axis.center() * axis.direction_M;
    box.half_extents[i] = std::max(0.0, axis.halfExtent());
  }
  if (box.X_MB.linear().determinant() < 0.0) box.X_MB.linear().col(0) *= -1.0;
  return box;
}

}  // namespace sweep_guard_core
