#include "prediction/displacement_regression.h"

#include <algorithm>
#include <limits>

namespace sweep_guard_core {

// A tool at rest teaches nothing, and makes nothing forgotten: time counts as far as it is spent in motion.
void DisplacementRegression::learn(const Velocities& velocities, const Eigen::Vector3d& moved, double period) {
  const Eigen::Vector3d steady = ahead_ * velocities.col(0);
  const double motion = std::max(moved.norm(), steady.norm()) / (prior_speed_ * ahead_);
  const double taught = period * std::min(1.0, motion);
  const Eigen::Vector3d besides = moved - steady;
  errors_.add({(besides - velocities * learned_).norm(), besides.norm(), moved.norm()}, taught);
  fit_.forget(decay(taught));
  for (int axis = 0; axis < 3; ++axis) {
    fit_.add(velocities.row(axis).transpose(), Eigen::Matrix<double, 1, 1>(besides[axis]), taught);
  }
  learned_ = fit_.coefficients(kVelocities, prior_speed_ * prior_speed_);
  blend();
}

// The fourth power lets the best of the three prevail without a jump where another takes over.
void DisplacementRegression::blend() {
  const Eigen::Array3d errors = errors_.mean() + std::numeric_limits<double>::min();
  const Eigen::Array3d share = (errors.minCoeff() / errors).square().square();
  weights_ = (share[0] * learned_ + (share[0] + share[1]) * ahead_ * Weights::Unit(0)) / share.sum();
}

}  // namespace sweep_guard_core
