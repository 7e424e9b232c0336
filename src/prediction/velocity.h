#pragma once

#include "prediction/motion_tracker.h"
#include "prediction/polynomial_fit.h"

namespace sweep_guard_core {

/// Adds the newest sample of a tracker to a fit of its coordinates, which restarts after an interruption.
template <typename Space>
void follow(PolynomialFit<Space::kSize>& fit, const MotionTracker<Space>& tracker);

/// Measures a velocity by least squares over the newest part of a motion, or over the newest two samples if they are
/// farther apart.
template <typename Space>
class Velocity {
 public:
  using Vector = typename Space::Vector;

  /// @param window  time over which the velocity is measured, > 0
  explicit Velocity(Duration window) : fit_({/*degree=*/1, window, /*forgetting_factor=*/1.0}) {}

  void observe(const MotionTracker<Space>& tracker);

  /// Returns the velocity within the limits of the tracker, 0 after the first sample. Of a tool: along the axes of W
  /// [m/s], then about the tool's own axes [rad/s].
  const Vector& value() const { return value_; }

 private:
  PolynomialFit<Space::kSize> fit_;
  Vector value_ = Vector::Zero();
};

}  // namespace sweep_guard_core
