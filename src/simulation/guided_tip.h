#pragma once

#include <Eigen/Geometry>

#include "simulation/twist.h"

namespace sweep_guard_simulation {

/// The tip of a tool that a hand guides from one moment to the next. Whatever is asked of it, it moves as a body can:
/// speed and acceleration are bounded, so that a target which jumps is a motion and not a leap.
class GuidedTip {
 public:
  struct Limits {
    double speed = 0.25;             ///< [m/s] > 0
    double acceleration = 1.0;       ///< [m/s^2] > 0
    double turn_rate = 1.5;          ///< [rad/s] > 0
    double turn_acceleration = 6.0;  ///< [rad/s^2] > 0
  };

  /// At rest.
  /// @param X_WT  of the frame whose origin is the tip
  /// @throws sweep_guard_core::InvalidInput if a limit is not above 0
  GuidedTip(const Eigen::Isometry3d& X_WT, const Limits& limits);

  const Eigen::Isometry3d& pose() const { return X_WT_; }

  /// At rest again: nobody saw it move for a while.
  void rest() { velocity_ = Twist(); }

  /// Moves on by `dt` [s] > 0 at this velocity, or as near to it as the limits allow.
  void moveAt(const Twist& wanted, double dt);

  /// Moves on by `dt` [s] > 0 towards a pose, at the highest speed from which it can still stop there. Without
  /// overshooting one that rests, from rest; the rotation takes the shorter way.
  void moveTowards(const Eigen::Isometry3d& goal_W, double dt);

 private:
  Eigen::Isometry3d X_WT_;
  Limits limits_;
  Twist velocity_;
};

}  // namespace sweep_guard_simulation
