#pragma once

#include <array>
#include <vector>

#include "prediction/delayed_targets.h"
#include "prediction/exponential_moving_average.h"
#include "prediction/pose_tracker.h"
#include "sweep_guard/common/matrix6.h"

namespace sweep_guard_core {

/// Predicted displacements of the tool within each of kLearnedHorizons.
using PredictedDisplacements = std::array<Vector6d, kLearnedHorizons.size()>;

/// Learns the errors of predictions from the motion that followed: the mean square of the recent errors along the
/// motion, across it and in rotation. The errors scale with the speed.
class ErrorModel {
 public:
  /// Errors within each of kLearnedHorizons, relative to the displacement at the current speed: along the motion, across
  /// it, in rotation.
  using Shares = std::array<Eigen::Array3d, kLearnedHorizons.size()>;

  ErrorModel();

  Shares shares() const;
  /// Begins with these shares where they are larger than those that it assumes.
  void begin(const Shares& shares);

  /// Adds the newest pose of a tracker and what is predicted there.
  /// @param velocity  of the tool: along the axes of W [m/s], then about the tool's own axes [rad/s]
  void observe(const PoseTracker& tracker, const Vector6d& velocity, const PredictedDisplacements& predicted);

  /// Returns the covariance of a predicted pose's error: translation [m], then rotation vector [rad], both along the
  /// axes of W.
  /// @param ahead  time after the newest pose [s], > 0
  Matrix6d covariance(double ahead) const;

 private:
  // Mean squares per axis: along the motion, across it, in rotation.
  using Squares = Eigen::Array3d;
  struct ErrorStatistics {
    ExponentialMovingAverage<Squares> errors;
    ExponentialMovingAverage<Squares> activity;  // squared speed at the time of the errors
  };
  struct Features {
    PredictedDisplacements predicted;
    Squares activity;
    Eigen::Vector3d direction;
  };

  static ErrorStatistics priorStatistics(double ahead, const Squares& share);
  Squares share(size_t horizon) const;

  DelayedTargets<Features> targets_;
  std::vector<ErrorStatistics> statistics_;                    // for each of kLearnedHorizons
  ExponentialMovingAverage<Squares> speeds_{Squares::Zero()};  // of the tool
  Squares activity_ = Squares::Zero();                         // current squared speed plus the mean
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();        // of the motion in W: unit, or 0 at rest
};

}  // namespace sweep_guard_core
