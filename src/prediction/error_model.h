#pragma once

#include <array>
#include <vector>

#include "prediction/delayed_targets.h"
#include "prediction/exponential_moving_average.h"
#include "prediction/motion_tracker.h"

namespace sweep_guard_core {

/// Predicted displacements within each of kLearnedHorizons.
template <typename Space>
using PredictedDisplacements = std::array<typename Space::Vector, kLearnedHorizons.size()>;

/// Learns the errors of predictions from the motion that followed: the mean square of the recent errors, of a tool
/// along the motion, across it and in rotation. The errors scale with the speed.
template <typename Space>
class ErrorModel {
 public:
  using Vector = typename Space::Vector;
  using Covariance = Eigen::Matrix<double, Space::kSize, Space::kSize>;

  explicit ErrorModel(const Space& space);

  /// Adds the newest pose of a tracker and what is predicted there.
  /// @param velocity  as Velocity measures it
  void observe(const MotionTracker<Space>& tracker, const Vector& velocity,
               const PredictedDisplacements<Space>& predicted);

  /// Forgets the predictions whose errors are not known yet, and keeps what was learned.
  void interrupt();

  /// Returns whether the newest error within 0.1 s exceeds three standard deviations, and that of another model.
  bool misleads(const ErrorModel& other) const { return (newest_ > limit_ && newest_ > other.newest_).any(); }

  /// Returns the covariance of the error of what is predicted. Of a pose: translation [m], then rotation vector [rad],
  /// both along the axes of W.
  /// @param ahead  time after the newest pose [s], > 0
  Covariance covariance(double ahead) const;

 private:
  // Mean squares per axis, for each kind of error.
  using Squares = Eigen::Array<double, Space::kErrors, 1>;
  using Direction = Eigen::Matrix<double, Space::kAxes, 1>;
  struct Features {
    PredictedDisplacements<Space> predicted;
    Squares activity;
    Direction direction;
  };

  /// Returns the error within kLearnedHorizons[horizon], relative to the displacement at the current speed.
  Squares share(size_t horizon) const;

  DelayedTargets<Space, Features> targets_;
  Squares newest_ = Squares::Zero();  // error within 0.1 s
  Squares limit_ = Squares::Zero();   // nine variances of it
  // For each of kLearnedHorizons: the errors, and the squared speed at the time of the errors.
  std::vector<ExponentialMovingAverage<Squares>> errors_;
  std::vector<ExponentialMovingAverage<Squares>> activities_;
  ExponentialMovingAverage<Squares> speeds_{Squares::Zero()};
  Squares activity_ = Squares::Zero();       // current squared speed plus the mean
  Direction direction_ = Direction::Zero();  // of the motion: unit, or 0 at rest
};

}  // namespace sweep_guard_core
