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

}  // namespace

OrientedBox boundingBox(const ConvexShape& shape, const Motion& motion) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covarianceOfBoth(shape.moments_T(), motion));
  assert(solver.info() == Eigen::Success);

  const Eigen::Matrix3d& axes_M = solver.eigenvectors();
  Eigen::Vector3d half_extents;
  Eigen::Vector3d center;  // along the axes
  for (int i = 0; i < 3; ++i) {
    const double lower = -support(shape, motion, -axes_M.col(i));
    const double upper = support(shape, motion, axes_M.col(i));
    half_extents[i] = 0.5 * (upper - lower);
    center[i] = 0.5 * (upper + lower);
  }
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(), [&](int i, int j) { return half_extents[i] < half_extents[j]; });

  OrientedBox box;
  for (int i = 0; i < 3; ++i) {
    const int axis = order[static_cast<size_t>(i)];
    box.X_MB.linear().col(i) = axes_M.col(axis);
    box.X_MB.translation() += center[axis] * axes_M.col(axis);
    box.half_extents[i] = std::max(0.0, half_extents[axis]);
  }
  if (box.X_MB.linear().determinant() < 0.0) box.X_MB.linear().col(0) *= -1.0;
  return box;
}

}  // namespace sweep_guard_core
