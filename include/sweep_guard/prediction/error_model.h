#pragma once

#include <array>
#include <vector>

#include "sweep_guard/common/matrix6.h"
#include "sweep_guard/prediction/hindsight.h"
#include "sweep_guard/prediction/motion_track.h"
#include "sweep_guard/prediction/recent_mean.h"

namespace sweep_guard {

/// How far the tool is expected to go within each of kLearnedAhead.
using Forecast = std::array<Vector6d, kLearnedAhead.size()>;

/// Learns how far predictions err from how they turned out: the mean square of the recent errors, along the motion,
/// across it and in rotation; greater in fast motion than in slow.
class ErrorModel {
 public:
  ErrorModel();

  /// Tells what is forecast at the newest pose of a track.
  /// @param velocity  of the tool there: along the axes of W [m/s], then about the tool's own [rad/s]
  void observe(const MotionTrack& track, const Vector6d& velocity, const Forecast& forecast);

  /// Of the error of a pose predicted: translation [m], then rotation vector [rad], both along the axes of W.
  /// @param ahead  of the newest pose [s], > 0
  Matrix6d covariance(double ahead) const;

 private:
  // Squares per axis: along the motion, across it, in rotation.
  using Squares = Eigen::Array3d;
  struct Record {
    RecentMean<Squares> errors;
    RecentMean<Squares> activity;  // that they came with
  };
  struct Known {
    Forecast forecast;
    Squares activity;
    Eigen::Vector3d direction;
  };

  static Record recordBefore(double ahead);

  Hindsight<Known> hindsight_;
  std::vector<Record> records_;                          // of kLearnedAhead
  RecentMean<Squares> speeds_{Squares::Zero()};          // of the tool
  Squares activity_ = Squares::Zero();                   // squared speed now plus the usual one
  Eigen::Vector3d direction_ = Eigen::Vector3d::Zero();  // of the motion in W, unit; 0 at rest
};

}  // namespace sweep_guard
