#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "simulation/guided_tip.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// Converts the axes of an input device into a velocity of the tool: 0 within a dead zone, proportional to the
/// deflection beyond its border, and 0 when the device sends nothing.
class Joystick {
 public:
  /// The defaults suit a SpaceMouse with axes 0 to 2: forward, left, up, and 3 to 5: rotations about them.
  struct Options {
    std::array<int, 3> linear_axes = {0, 1, 2};   ///< axes of the device that move x, y, z of W; -1: none
    std::array<int, 3> angular_axes = {3, 4, 5};  ///< axes of the device that rotate about x, y, z of W; -1: none
    Eigen::Vector3d linear = Eigen::Vector3d::Constant(0.15);             ///< [m/s] at full deflection; < 0: reversed
    Eigen::Vector3d angular = Eigen::Vector3d::Constant(0.8);             ///< [rad/s] at full deflection; < 0: reversed
    double dead_zone = 0.1;                                               ///< in [0, 1); share of the full deflection
    sweep_guard_core::Duration timeout = std::chrono::milliseconds(250);  ///< without messages, after it the tool stops
  };

  /// @throws sweep_guard_core::InvalidInput if an option is out of range
  explicit Joystick(const Options& options);

  /// Sets the axes of the device.
  /// @param axes  1 at full deflection; larger values count as 1
  /// @throws sweep_guard_core::InvalidInput if a required axis is missing or not finite; then nothing changes
  void setAxes(const std::vector<float>& axes, sweep_guard_core::Time at);

  /// Forgets the axes, and ignores those that are set before `until`, because their messages may have waited.
  void ignoreUntil(sweep_guard_core::Time until);

  Twist velocity(sweep_guard_core::Time at) const;

 private:
  Options options_;
  Twist newest_;
  std::optional<sweep_guard_core::Time> newest_at_;
  sweep_guard_core::Time ignored_until_;
};

}  // namespace sweep_guard_simulation
