#pragma once

#include <Eigen/Core>

#include "prediction/exponential_moving_average.h"
#include "prediction/rls.h"

namespace sweep_guard_core {

/// Learns the tool's displacement within one horizon from the operator's velocities. A recursive least squares fit
/// regresses the displacement on the velocities before it, with coefficients that the three axes share. Before it has
/// learned, it assumes constant velocity. If its errors exceed those of constant velocity or of no motion, it blends
/// with these. For translation [m, m/s] or rotation [rad, rad/s].
class DisplacementRegression {
 public:
  static constexpr int kVelocities = 5;
  using Velocities = Eigen::Matrix<double, 3, kVelocities>;  ///< one per column; the first is the newest
  using Weights = Eigen::Matrix<double, kVelocities, 1>;     ///< [s]; predicted displacement: velocities * weights

  /// @param ahead        the horizon [s], > 0
  /// @param prior_speed  speed at which a second of motion outweighs the assumption of constant velocity, > 0; slower
  ///                     motion has less weight
  DisplacementRegression(double ahead, double prior_speed) : ahead_(ahead), prior_speed_(prior_speed) {}

  /// Learns from one pose.
  /// @param velocities  at the pose
  /// @param moved       displacement within the horizon after the pose
  /// @param period      since the previous pose [s], > 0
  void learn(const Velocities& velocities, const Eigen::Vector3d& moved, double period);

  const Weights& weights() const { return weights_; }

 private:
  void blend();

  double ahead_;
  double prior_speed_;
  Rls<kVelocities, 1> fit_;
  Weights learned_ = Weights::Zero();  // in addition to constant velocity
  // Errors of the fit, of constant velocity, of no motion.
  ExponentialMovingAverage<Eigen::Array3d> errors_{Eigen::Array3d(0.0, 0.0, prior_speed_* ahead_), /*weight=*/0.1};
  Weights weights_ = ahead_ * Weights::Unit(0);
};

}  // namespace sweep_guard_core
