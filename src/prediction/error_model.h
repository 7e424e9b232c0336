#pragma once

#include <array>
#include <vector>

#include "prediction/delayed_targets.h"
#include "prediction/exponential_moving_average.h"
#include "prediction/pose_tracker.h"
#include "sweep_guard/common/matrix6.h"

namespace sweep_guard_core {

/// How far the tool is expected to go within each of kLearnedHorizons.
using PredictedDisplacements = std::array<Vector6d, kLearnedHorizons.size()>;

/// Learns how far predictions err from how they turned out: the mean square of the recent errors, along the motion,
/// across it and in rotation; greater in fast motion than in slow.
class ErrorModel {
 public:
  ErrorModel();

  /// Tells what is predicted at the newest pose of a tracker.
  /// @param velocity  of the tool there: along the axes of W [m/s], then about the tool's own [rad/s]
  void observe(const PoseTracker& tracker, const Vector6d& velocity, const PredictedDisplacements& predicted);

  /// Of the error of a pose predicted: translation [m], then rotation vector [rad], both along the axes of W.
  /// @param ahead  of the newest pose [s], > 0
  Matrix6d covariance(double ahead) const;

 private:
  // Squares per axis: along the motion, across it, in rotation.
  using Squares = Eigen::Array3d;
  struct Record {
    ExponentialMovingAverage<Squares> errors;
    ExponentialMovingAverage<Squares> activity;  // that they came with
  };
  struct Known {
    PredictedDisplacements predicted;
    Squares activity;
    Eigen::Vector3d direction;
  };

  static Record recordBefore(double ahead);

  DelayedTargets<Known> targets_;
  std::vector<Record> records_;                                // of kLearnedHorizons
  ExponentialMovingAverage<Squares> speeds_{Squares::Zero()};  // of the tool
  Squares activity_ = Squares::Zero();                         // squared speed now plus the usual one
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();        // of the motion in W, unit; 0 at rest
};

}  // namespace sweep_guard_core
