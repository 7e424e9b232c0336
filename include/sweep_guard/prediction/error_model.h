#pragma once

#include <array>

#include "sweep_guard/prediction/hindsight.h"
#include "sweep_guard/prediction/motion_track.h"

namespace sweep_guard {

/// How far the tool is expected to go within each of kLearnedAhead.
using Forecast = std::array<Vector6d, kLearnedAhead.size()>;

/// Learns how far predictions err from how they turned out: the mean square of the recent errors (20 s), for
/// translation and for rotation, the same along all axes, greater in fast motion than in slow.
class ErrorModel {
 public:
  struct Variance {
    double translation;  ///< along any axis [m^2]
    double rotation;     ///< about any axis [rad^2]
  };

  ErrorModel();

  /// Tells what is forecast at the newest pose of a track.
  void observe(const MotionTrack& track, const Vector6d& velocity, const Forecast& forecast);

  /// @param ahead  of the newest pose [s], > 0
  Variance variance(double ahead) const;

 private:
  // Errors of one kind, translation or rotation, within one horizon.
  struct Record {
    double squares;   // of the errors along an axis, weighted by time
    double activity;  // that they came with, weighted by time
  };
  struct Known {
    Forecast forecast;
    Eigen::Vector2d activity;
  };

  Eigen::Vector2d activityAt(const MotionTrack& track, const Vector6d& velocity);

  Hindsight<Known> hindsight_;
  std::array<std::array<Record, kLearnedAhead.size()>, 2> records_;
  Eigen::Vector2d speed_squares_ = Eigen::Vector2d::Zero();  // recent, weighted [s]
  double weight_ = 0.0;                                      // [s]
  Eigen::Vector2d activity_ = Eigen::Vector2d::Zero();       // squared speed now plus the usual one, of either kind
};

}  // namespace sweep_guard
