#pragma once

#include "sweep_guard/prediction/motion_track.h"
#include "sweep_guard/prediction/polynomial_fit.h"

namespace sweep_guard {

/// Lets a fit take in the newest pose of a track: the coordinates of a motion without interruption.
void follow(PolynomialFit& fit, const MotionTrack& track);

/// Speed of a tool, measured by least squares over the newest part of its motion; over its newest two poses where they
/// are farther apart.
class Velocity {
 public:
  /// @param window  part of the motion that counts, > 0
  explicit Velocity(Duration window) : fit_({/*degree=*/1, window, /*forgetting_factor=*/1.0}) {}

  void observe(const MotionTrack& track);

  /// Along the axes of W [m/s], then about the tool's own axes [rad/s], within the limits of the track; 0 after the
  /// first pose.
  const Vector6d& value() const { return value_; }

 private:
  PolynomialFit fit_;
  Vector6d value_ = Vector6d::Zero();
};

}  // namespace sweep_guard
