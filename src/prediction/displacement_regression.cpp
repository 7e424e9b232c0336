#include "prediction/displacement_regression.h"

#include <algorithm>
#include <limits>

#include "prediction/motion_space.h"

namespace sweep_guard_core {
namespace {

constexpr double kOutlier = 2.0;     // errors larger than this, relative to the mean error, lose weight [Huber]
constexpr double kRestShare = 0.03;  // prior information of one second at the prior speed

// Of a profile, so that another operator's is soon outgrown:
constexpr double kProfileTime = 5.0;    // it counts as this much motion at most [s]
constexpr double kProfileFading = 4.0;  // it is forgotten so many times as fast as motion
constexpr double kProfileTrust = 0.5;   // its errors count as those of this much motion at most [s]

}  // namespace

// Time is weighted by motion: a tool at rest neither teaches nor forgets anything.
template <int Axes>
void DisplacementRegression<Axes>::learn(const Observation& observation, const Weights& expected) {
  const auto& [velocities, moved, period] = observation;
  const Moved steady = ahead_ * velocities.col(0);
  const double motion = std::max(moved.norm(), steady.norm()) / (prior_speed_ * ahead_);
  const double weight = period * std::min(1.0, motion);
  const double error = (moved - velocities * learned_).norm();
  errors_.add({error, (moved - steady).norm(), moved.norm()}, weight);
  const double limit = kOutlier * errors_.mean()[0];
  const double robust_weight = error > limit ? limit / error * weight : weight;
  fit_.forget(decay(weight));
  time_ = decay(weight) * time_ + weight;
  profile_time_ *= decay(kProfileFading * weight);
  for (int axis = 0; axis < Axes; ++axis) {
    fit_.add(velocities.row(axis).transpose(), Eigen::Matrix<double, 1, 1>(moved[axis]), robust_weight);
  }
  learned_ = fit().coefficients(prior(), expected);
  blend();
}

template <int Axes>
typename DisplacementRegression<Axes>::Learned DisplacementRegression<Axes>::learned() const {
  const Fit all = fit();
  return {all.information(), all.projection(), errors_.mean(), time_ + profile_time_};
}

template <int Axes>
void DisplacementRegression<Axes>::begin(const Learned& learned, const Weights& expected) {
  const double moved = learned.errors[2];
  if (moved == 0.0 || learned.time == 0.0) return;
  const double scale = 1.0 / (learned.time * moved * moved);
  profile_ = {scale * learned.information, scale * learned.projection};
  profile_time_ = std::min(learned.time, kProfileTime);
  errors_ = ExponentialMovingAverage<Eigen::Array3d>(learned.errors, std::min(learned.time, kProfileTrust));
  learned_ = fit().coefficients(prior(), expected);
  blend();
}

// As if the profile were of an operator as fast as this one: the information of a faster one would outweigh his for long.
template <int Axes>
typename DisplacementRegression<Axes>::Fit DisplacementRegression<Axes>::fit() const {
  const double moved = errors_.mean()[2];
  Fit all = fit_;
  all.add(profile_, profile_time_ * moved * moved);
  return all;
}

// Bayes: errors per axis of variance s^2, one independent error per horizon, weights expected within one horizon.
template <int Axes>
double DisplacementRegression<Axes>::prior() const {
  const double error = errors_.mean()[0];
  return error * error / Axes / ahead_ + kRestShare * prior_speed_ * prior_speed_;
}

// The fourth power favors the best of the three, and changes continuously when another one becomes the best.
template <int Axes>
void DisplacementRegression<Axes>::blend() {
  const Eigen::Array3d errors = errors_.mean() + std::numeric_limits<double>::min();
  const Eigen::Array3d share = (errors.minCoeff() / errors).square().square();
  weights_ = (share[0] * learned_ + share[1] * constantVelocity(ahead_)) / share.sum();
}

template class DisplacementRegression<PoseSpace::kAxes>;
template class DisplacementRegression<JointSpace::kAxes>;

}  // namespace sweep_guard_core
