#pragma once

#include <Eigen/Core>

#include "prediction/exponential_moving_average.h"
#include "prediction/rls.h"

namespace sweep_guard_core {

/// Number of velocities of the measured motion that a displacement is regressed on, and of these and those of a command.
constexpr int kRegressors = 8;
constexpr int kCommandRegressors = kRegressors + 4;

/// Learns the displacement of a tool or a joint within one horizon from the operator's velocities. A recursive least squares fit
/// regresses the displacement on the velocities before it, with coefficients that its axes share; outliers have
/// less weight. Before it has learned, it assumes constant velocity. If its errors exceed those of constant velocity or
/// of no motion, it blends with these. For translation [m, m/s] or rotation [rad, rad/s].
/// @tparam Axes  number of axes that share the coefficients: 3 of a tool, 1 of a joint
/// @tparam N     number of velocities
template <int Axes, int N = kRegressors>
class DisplacementRegression {
 public:
  using Velocities = Eigen::Matrix<double, Axes, N>;  ///< one per column; the first is the newest
  using Moved = Eigen::Matrix<double, Axes, 1>;
  using Weights = Eigen::Matrix<double, N, 1>;  ///< [s]; predicted displacement: velocities * weights

  /// @param ahead        the horizon [s], > 0
  /// @param prior_speed  motion at this speed has full weight, slower motion has less, > 0
  DisplacementRegression(double ahead, double prior_speed) : ahead_(ahead), prior_speed_(prior_speed) {}

  /// Returns the weights of motion that goes on at the newest velocity.
  static Weights constantVelocity(double ahead) { return ahead * Weights::Unit(0); }

  /// Learns from the motion after one pose.
  /// @param velocities  at the pose
  /// @param moved       displacement within the horizon after the pose
  /// @param period      since the previous pose [s], > 0
  /// @param expected    weights that the fit leans towards, the more so the larger its errors
  void learn(const Velocities& velocities, const Moved& moved, double period, const Weights& expected);

  const Weights& weights() const { return weights_; }

 private:
  double prior() const;
  void blend();

  double ahead_;
  double prior_speed_;
  Rls<N, 1> fit_;
  Weights learned_ = constantVelocity(ahead_);
  // Errors of the fit, of constant velocity, of no motion.
  ExponentialMovingAverage<Eigen::Array3d> errors_{Eigen::Array3d(0.0, 0.0, prior_speed_* ahead_), /*weight=*/0.1};
  Weights weights_ = constantVelocity(ahead_);
};

}  // namespace sweep_guard_core
