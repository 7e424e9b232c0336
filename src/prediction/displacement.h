#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Returns the displacement of a tool from one pose to another: translation along the axes of W [m], then the rotation
/// vector about the tool's own axes [rad]. The rotation is at most pi, whatever wraps and the signs of quaternions are.
inline Vector6d displacement(const Eigen::Isometry3d& X_WT_from, const Eigen::Isometry3d& X_WT_to) {
  const Eigen::AngleAxisd turn(X_WT_from.linear().transpose() * X_WT_to.linear());
  Vector6d moved;
  moved << X_WT_to.translation() - X_WT_from.translation(), turn.angle() * turn.axis();
  return moved;
}

/// Returns the vector, shortened to `length` if it is longer.
inline Eigen::Vector3d limited(const Eigen::Vector3d& vector, double length) {
  const double norm = vector.norm();
  return norm > length ? Eigen::Vector3d(length / norm * vector) : vector;
}

/// Returns the pose after a displacement.
inline Eigen::Isometry3d displaced(const Eigen::Isometry3d& X_WT, const Vector6d& displacement) {
  const Eigen::Vector3d turn = displacement.tail<3>();
  const double angle = turn.norm();
  Eigen::Isometry3d X_WT_to = X_WT;
  X_WT_to.translation() += displacement.head<3>();
  if (angle > 0.0) X_WT_to.linear() *= Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  return X_WT_to;
}

}  // namespace sweep_guard_core
