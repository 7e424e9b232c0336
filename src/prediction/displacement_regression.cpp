#include "prediction/displacement_regression.h"

#include <algorithm>
#include <limits>

namespace sweep_guard_core {

// Time is weighted by motion: a tool at rest neither teaches nor forgets anything.
void DisplacementRegression::learn(const Velocities& velocities, const Eigen::Vector3d& moved, double period) {
  const Eigen::Vector3d steady = ahead_ * velocities.col(0);
  const double motion = std::max(moved.norm(), steady.norm()) / (prior_speed_ * ahead_);
  const double weight = period * std::min(1.0, motion);
  const Eigen::Vector3d rest = moved - steady;
  errors_.add({(rest - velocities * learned_).norm(), rest.norm(), moved.norm()}, weight);
  fit_.forget(decay(weight));
  for (int axis = 0; axis < 3; ++axis) {
    fit_.add(velocities.row(axis).transpose(), Eigen::Matrix<double, 1, 1>(rest[axis]), weight);
  }
  learned_ = fit_.coefficients(kVelocities, prior_speed_ * prior_speed_);
  blend();
}

// The fourth power favors the best of the three, and changes continuously when another one becomes the best.
void DisplacementRegression::blend() {
  const Eigen::Array3d errors = errors_.mean() + std::numeric_limits<double>::min();
  const Eigen::Array3d share = (errors.minCoeff() / errors).square().square();
  weights_ = (share[0] * learned_ + (share[0] + share[1]) * ahead_ * Weights::Unit(0)) / share.sum();
}

}  // namespace sweep_guard_core
