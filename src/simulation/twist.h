#pragma once

#include <Eigen/Core>

namespace sweep_guard_simulation {

/// Velocity of a tool.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< of the tip, in W [m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< in W [rad/s]
};

}  // namespace sweep_guard_simulation
