#pragma once

#include "prediction/polynomial_fit.h"
#include "prediction/pose_tracker.h"

namespace sweep_guard_core {

/// Lets a fit take in the newest pose of a tracker: the coordinates of a motion without interruption.
void follow(PolynomialFit& fit, const PoseTracker& tracker);

/// Speed of a tool, measured by least squares over the newest part of its motion; over its newest two poses where they
/// are farther apart.
class Velocity {
 public:
  /// @param window  part of the motion that counts, > 0
  explicit Velocity(Duration window) : fit_({/*degree=*/1, window, /*forgetting_factor=*/1.0}) {}

  void observe(const PoseTracker& tracker);

  /// Along the axes of W [m/s], then about the tool's own axes [rad/s], within the limits of the tracker; 0 after the
  /// first pose.
  const Vector6d& value() const { return value_; }

 private:
  PolynomialFit fit_;
  Vector6d value_ = Vector6d::Zero();
};

}  // namespace sweep_guard_core
