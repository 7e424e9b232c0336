#pragma once

#include <Eigen/Geometry>

namespace sweep_guard_core {

/// Returns the rotation vector of R in W [rad], at most pi long.
inline Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

/// Returns an orientation after a turn by a rotation vector in W [rad], orthonormal.
inline Eigen::Matrix3d turnedBy(const Eigen::Matrix3d& R_WT, const Eigen::Vector3d& turn_W) {
  const double angle = turn_W.norm();
  if (!(angle > 0.0)) return R_WT;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, turn_W / angle).toRotationMatrix() * R_WT;
  return Eigen::Quaterniond(R).normalized().toRotationMatrix();
}

/// Shortens a vector that is longer than a limit. Returns whether it was.
inline bool shorten(Eigen::Vector3d& vector, double limit) {
  const double length = vector.norm();
  if (length <= limit) return false;
  vector *= limit / length;
  return true;
}

}  // namespace sweep_guard_core
