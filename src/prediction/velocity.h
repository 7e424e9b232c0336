#pragma once

#include "prediction/polynomial_fit.h"
#include "prediction/pose_tracker.h"

namespace sweep_guard_core {

/// Adds the newest pose of a tracker to a fit of its coordinates, which restarts after an interruption.
void follow(PolynomialFit& fit, const PoseTracker& tracker);

/// Measures the velocity of a tool by least squares over the newest part of its motion, or over the newest two poses if
/// they are farther apart.
class Velocity {
 public:
  /// @param window  time over which the velocity is measured, > 0
  explicit Velocity(Duration window) : fit_({/*degree=*/1, window, /*forgetting_factor=*/1.0}) {}

  void observe(const PoseTracker& tracker);

  /// Returns the velocity along the axes of W [m/s], then about the tool's own axes [rad/s], within the limits of the
  /// tracker; 0 after the first pose.
  const Vector6d& value() const { return value_; }

 private:
  PolynomialFit fit_;
  Vector6d value_ = Vector6d::Zero();
};

}  // namespace sweep_guard_core
