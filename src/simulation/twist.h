#pragma once

#include <Eigen/Core>

namespace sweep_guard_simulation {

/// Velocity of a tool that is led by its tip.
struct Twist {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< of the tip along the axes of W [m/s]
  Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< about the tip and the axes of W [rad/s]
};

}  // namespace sweep_guard_simulation
