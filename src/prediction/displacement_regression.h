#pragma once

#include <Eigen/Core>

#include "prediction/exponential_moving_average.h"
#include "prediction/rls.h"

namespace sweep_guard_core {

/// Learns how far an operator's velocities carry the tool within one horizon: a recursive least squares fit of the
/// displacement that really came on the velocities known before, the coefficients shared by the three axes. What it has
/// not learned yet is constant velocity; where its own errors turn out worse than those of constant velocity or of
/// holding still, it leans on these. For translation [m, m/s] or rotation [rad, rad/s].
class DisplacementRegression {
 public:
  static constexpr int kVelocities = 5;
  using Velocities = Eigen::Matrix<double, 3, kVelocities>;  ///< one per column, the first of them the newest
  using Weights = Eigen::Matrix<double, kVelocities, 1>;     ///< [s] displacement expected: velocities * weights

  /// @param ahead        the horizon [s], > 0
  /// @param prior_speed  a second of motion at this speed outweighs the assumption of constant velocity; slower motion
  ///                     teaches less, > 0
  DisplacementRegression(double ahead, double prior_speed) : ahead_(ahead), prior_speed_(prior_speed) {}

  /// @param velocities  known at a pose
  /// @param moved       displacement that came within the horizon after it
  /// @param period      since the pose before [s], > 0
  void learn(const Velocities& velocities, const Eigen::Vector3d& moved, double period);

  const Weights& weights() const { return weights_; }

 private:
  void blend();

  double ahead_;
  double prior_speed_;
  Rls<kVelocities, 1> fit_;
  Weights learned_ = Weights::Zero();  // what the velocities carry besides constant velocity
  // Of what was learned, of constant velocity, of holding still.
  ExponentialMovingAverage<Eigen::Array3d> errors_{Eigen::Array3d(0.0, 0.0, prior_speed_* ahead_), /*weight=*/0.1};
  Weights weights_ = ahead_ * Weights::Unit(0);
};

}  // namespace sweep_guard_core
