#include "prediction/displacement_regression.h"

#include <algorithm>
#include <limits>

#include "prediction/motion_space.h"

namespace sweep_guard_core {
namespace {

constexpr double kOutlier = 2.0;     // errors larger than this, relative to the mean error, lose weight [Huber]
constexpr double kRestShare = 0.03;  // prior information of one second at the prior speed

}  // namespace

// Time is weighted by motion: a tool at rest neither teaches nor forgets anything.
template <int Axes, int N>
void DisplacementRegression<Axes, N>::learn(const Velocities& velocities, const Moved& moved, double period,
                                            const Weights& expected) {
  const Moved steady = ahead_ * velocities.col(0);
  const double motion = std::max(moved.norm(), steady.norm()) / (prior_speed_ * ahead_);
  const double weight = period * std::min(1.0, motion);
  const double error = (moved - velocities * learned_).norm();
  errors_.add({error, (moved - steady).norm(), moved.norm()}, weight);
  const double limit = kOutlier * errors_.mean()[0];
  const double robust_weight = error > limit ? limit / error * weight : weight;
  fit_.forget(decay(weight));
  for (int axis = 0; axis < Axes; ++axis) {
    fit_.add(velocities.row(axis).transpose(), Eigen::Matrix<double, 1, 1>(moved[axis]), robust_weight);
  }
  learned_ = fit_.coefficients(prior(), expected);
  blend();
}

// Bayes: errors per axis of variance s^2, one independent error per horizon, weights expected within one horizon.
template <int Axes, int N>
double DisplacementRegression<Axes, N>::prior() const {
  const double error = errors_.mean()[0];
  return error * error / Axes / ahead_ + kRestShare * prior_speed_ * prior_speed_;
}

// The fourth power favors the best of the three, and changes continuously when another one becomes the best.
template <int Axes, int N>
void DisplacementRegression<Axes, N>::blend() {
  const Eigen::Array3d errors = errors_.mean() + std::numeric_limits<double>::min();
  const Eigen::Array3d share = (errors.minCoeff() / errors).square().square();
  weights_ = (share[0] * learned_ + share[1] * constantVelocity(ahead_)) / share.sum();
}

template class DisplacementRegression<PoseSpace::kAxes, kRegressors>;
template class DisplacementRegression<JointSpace::kAxes, kRegressors>;
template class DisplacementRegression<PoseSpace::kAxes, kCommandRegressors>;
template class DisplacementRegression<JointSpace::kAxes, kCommandRegressors>;

}  // namespace sweep_guard_core
