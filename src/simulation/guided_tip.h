#pragma once

#include <Eigen/Geometry>
#include <string>

#include "sweep_guard/motion/braking.h"
#include "sweep_guard/ros/parameters/parameter_reader.h"

namespace sweep_guard_simulation {

using sweep_guard_core::Twist;

/// Moves the tip of a tool that is guided by hand. Bounds speed and acceleration, so the tip moves smoothly even if its
/// target jumps.
class GuidedTip {
 public:
  struct Limits {
    double speed = 0.25;             ///< [m/s] > 0
    double acceleration = 1.0;       ///< [m/s^2] > 0
    double turn_rate = 1.5;          ///< [rad/s] > 0
    double turn_acceleration = 6.0;  ///< [rad/s^2] > 0
  };

  /// Starts at rest.
  /// @param X_WT  of a frame with its origin at the tip
  /// @throws sweep_guard_core::InvalidInput if a limit is not above 0
  GuidedTip(const Eigen::Isometry3d& X_WT, const Limits& limits);

  const Eigen::Isometry3d& pose() const { return X_WT_; }

  void stop() { velocity_ = Twist(); }  ///< sets the velocity to zero at once

  /// Moves for `dt` [s] > 0 at a velocity of the tip, as far as the limits allow.
  void moveAt(const Twist& desired, double dt);

  /// Moves for `dt` [s] > 0 towards a goal, at the highest speed from which the tip can still stop there. From rest, it
  /// does not overshoot a goal at rest. Rotates by the smaller angle.
  void moveTowards(const Eigen::Isometry3d& goal_W, double dt);

 private:
  Eigen::Isometry3d X_WT_;
  Limits limits_;
  Twist velocity_;
};

/// Reads limits from private parameters: `speed`, `acceleration`, `turn_rate` and `turn_acceleration` of a group.
/// @param limits  without a parameter
GuidedTip::Limits readLimits(sweep_guard_ros::ParameterReader& parameters, const std::string& group,
                             GuidedTip::Limits limits);

/// Returns the pose of a tip that points down.
Eigen::Isometry3d pointingDown(const Eigen::Vector3d& p_W);

}  // namespace sweep_guard_simulation
