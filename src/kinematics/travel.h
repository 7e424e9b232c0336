#pragma once

#include <Eigen/Geometry>

namespace sweep_guard_core {

/// What is known of the points of a body while the joints of a robot move, by one joint after the other from the body to the
/// root. The bound is that of RobotMotion, per time or for a whole motion.
struct Travel {
  double path = 0.0;  ///< bound on the length of a point's path, seen from the link that the joints so far hang on [m]
  double curvature = 0.0;  ///< bound on |p''| there
  double turn = 0.0;       ///< bound on the turn of the body [rad]

  /// Adds a turn of all that has moved so far.
  /// @param distance  largest one of a point from the axis [m]
  void addTurn(double angle, double distance) {
    curvature += angle * angle * distance + 2.0 * angle * path;
    path += angle * distance;
    turn += angle;
  }
  void addSlide(double way) { path += way; }
};

/// Returns the distance of a point from the axis of a joint [m].
inline double distanceFromAxis(const Eigen::Vector3d& p, const Eigen::Isometry3d& X_RJ, const Eigen::Vector3d& axis_J) {
  return (X_RJ.linear() * axis_J).cross(p - X_RJ.translation()).norm();
}

}  // namespace sweep_guard_core
