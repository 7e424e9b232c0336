#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "simulation/twist.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// The axes of an input device as a velocity of the tool: 0 within a dead zone about the middle, from its border on in
/// proportion to the deflection, and 0 again when the device falls silent.
class Joystick {
 public:
  /// What a SpaceMouse needs whose axes are 0..2: forward, left, up and 3..5: about the same.
  struct Options {
    std::array<int, 3> linear_axes = {0, 1, 2};   ///< which of the device's axes moves x, y, z of W; -1: none
    std::array<int, 3> angular_axes = {3, 4, 5};  ///< which one turns about x, y, z of W; -1: none
    Eigen::Vector3d linear = Eigen::Vector3d::Constant(0.15);  ///< [m/s] at full deflection; < 0: the other way round
    Eigen::Vector3d angular = Eigen::Vector3d::Constant(0.8);  ///< [rad/s] at full deflection; < 0: the other way round
    double dead_zone = 0.1;  ///< in [0, 1); part of the full deflection that counts as none
    sweep_guard_core::Duration timeout =
        std::chrono::milliseconds(250);  ///< of silence after which the tool is to stop
  };

  /// @throws sweep_guard_core::InvalidInput if an option is out of range
  explicit Joystick(const Options& options);

  /// @param axes  of the device, 1 at full deflection; what is beyond counts as that
  /// @throws sweep_guard_core::InvalidInput if an axis that is used is missing or not finite; what came before stays in
  /// force
  void take(const std::vector<float>& axes, sweep_guard_core::Time at);

  /// Lets go of what was taken, and of all that is taken before `until`: it may have waited, nobody knows for how long.
  void releaseUntil(sweep_guard_core::Time until);

  Twist velocity(sweep_guard_core::Time at) const;

 private:
  Options options_;
  Twist newest_;
  std::optional<sweep_guard_core::Time> newest_at_;
  sweep_guard_core::Time released_until_;
};

}  // namespace sweep_guard_simulation
