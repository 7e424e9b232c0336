#pragma once

#include <Eigen/Core>
#include <limits>

#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_core {

/// A velocity of the tool, along the axes of the fixed frame W.
struct Twist {
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< of the origin of the tool frame [m/s]
  Eigen::Vector3d w_W = Eigen::Vector3d::Zero();  ///< angular velocity [rad/s]
};

inline bool operator==(const Twist& a, const Twist& b) { return a.v_W == b.v_W && a.w_W == b.w_W; }
inline bool operator!=(const Twist& a, const Twist& b) { return !(a == b); }

/// Returns the velocity of another point of a rigid body.
/// @param to_W  the other point, seen from the point of the twist [m]
Twist atPoint(const Twist& twist_W, const Eigen::Vector3d& to_W);

/// What the robot can do, and how close it may come.
struct BrakingLimits {
  double deceleration = 1.0;    ///< of the fastest tool point when the robot is stopped, along its path [m/s^2], > 0
  double reaction_time = 0.05;  ///< command period + age of planes or pose, the older + the robot's own lag [s], > 0
  double standoff = 0.002;      ///< distance from a plane at which the closing speed is 0 [m], >= 0
  double tool_radius = 0.1;     ///< largest distance of a tool point from the origin of the tool frame [m], >= 0
};

/// Says how near the surfaces may be that no plane stands for: those beyond the reach of the planes, and those left over.
struct UncoveredSurfaces {
  double distance = std::numeric_limits<double>::infinity();  ///< of the nearest one from the tool [m]
  double speed = 0.0;                                         ///< of the fastest one [m/s], >= 0
};

/// Returns the largest speed [m/s] from which a point can stop within a distance: the v for which v^2 / (2 deceleration)
/// + v reaction_time = distance; 0 for a negative distance.
double stoppingSpeed(double distance, const BrakingLimits& limits);

/// How a robot comes to rest that carries out a share of a command and is then stopped. No point leaves its path: for the reaction
/// time all go on, and then brake at one rate, the fastest one at `deceleration`. Ways along the path are times for which the
/// whole command would take them [s].
struct StopOnPath {
  double reaction_time;  ///< [s], > 0
  double braking_time;   ///< from the whole command: speed of the fastest point / deceleration [s], >= 0

  double way(double share) const { return share * (reaction_time + 0.5 * share * braking_time); }  ///< until rest [s]
  double untilRest(double share) const { return reaction_time + share * braking_time; }            ///< [s]
  double share(double way) const;  ///< that is at rest after this way, >= 0; may be above 1
};

/// Returns how long a gap lasts [s].
/// @param gap           [m], >= 0
/// @param closing       speed [m/s]; negative: the gap grows at first
/// @param acceleration  bound on how fast the closing speed grows [m/s^2], >= 0
double timeUntilClosed(double gap, double closing, double acceleration);

/// Returns whether a gap has grown when the robot is at rest, although its surface comes and the ball runs along an arc.
/// @param surface_speed  to the ball [m/s]
/// @param closing        speed by the whole command [m/s]
/// @param acceleration   bound on that of the ball by the whole command until rest [m/s^2], >= 0
/// @param share          of the command that is sent
bool opens(double surface_speed, double closing, double acceleration, const StopOnPath& stop, double share);

/// Returns how fast the tool's own motion brings a ball closer to its plane [m/s]; negative: the gap grows.
double closingSpeed(const FacingBall& ball, const Twist& twist_W);

/// Returns the average speed at which its arc brings a ball closer to its plane while the tool turns for a time [m/s]: an upper
/// bound, >= 0, that also holds for slower turns.
/// @param time  [s], >= 0
double arcClosing(const FacingBall& ball, const Eigen::Vector3d& w_W, double time);

/// Returns an upper bound of the speed of any tool point [m/s].
double fastestPoint(const Twist& twist_W, double tool_radius);

/// Returns the largest speed [m/s], >= 0, at which the tool can stop before what no plane stands for.
double allowedSpeed(const UncoveredSurfaces& uncovered, const BrakingLimits& limits);

/// @throws InvalidInput  if a value is NaN or out of range, with what it is
void requireUsable(const Twist& command_W);
void requireUsable(const FacingBall& ball);
void requireUsable(const UncoveredSurfaces& uncovered);
void requireUsable(const BrakingLimits& limits);

}  // namespace sweep_guard_core
