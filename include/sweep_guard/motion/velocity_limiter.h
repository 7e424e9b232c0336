#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/nearest_point.h"
#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_core {

/// How fast a command may bring one ball closer to its plane. What is sent, v' and w' = s w, closes on it by closing(), the arc
/// until rest included, and the robot then brakes along its path, the fastest tool point at `deceleration`.
struct ClosingRow {
  /// @param ball, command_W, limits  usable
  ClosingRow(const FacingBall& ball, const Twist& command_W, const BrakingLimits& limits);

  double closing(const Eigen::Vector3d& v_W, double s) const { return turning * s - normal_W.dot(v_W); }  ///< [m/s]

  Eigen::Vector3d normal_W;
  double turning;   ///< by the whole turn [m/s]
  double limit;     ///< of closing() [m/s], >= 0: the ball stops in time if the rest of the command goes on as it is
  double distance;  ///< gap less the standoff [m]
  double surface_speed;  ///< to the ball [m/s], >= 0
};

/// Limits the part of a commanded velocity that closes on surfaces. Keeps its buffers between calls.
class VelocityLimiter {
 public:
  /// @param balls  limit() allocates nothing for at most this many
  explicit VelocityLimiter(size_t balls);

  /// Returns the velocity nearest to the command that closes on no plane faster than ClosingRow::limit: with v' and w' = s
  /// w, s in [0, 1], for which |v' - v|^2 / |v|^2 + (1 - s)^2 is smallest. If v' or any tool point is then too fast, that
  /// is faster than v, or than can stop before what no plane stands for, or, between several planes, before one of them, both
  /// parts are scaled down. So where nothing closes too fast the command is returned as it is, nothing moves that was not
  /// commanded, and zero always remains.
  /// Closing speeds are exact to 1e-11 of the commanded speed of the fastest tool point; between planes that differ by
  /// 1e-8 rad or less from parallel or opposite, to 1.5e-6.
  /// @throws InvalidInput  if the command, a ball or a limit is not finite or out of range
  Twist limit(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
              const BrakingLimits& limits);

 private:
  void collectRows(const Twist& command_W, const std::vector<FacingBall>& facing, const BrakingLimits& limits);
  void collectHalfSpaces(double speed);
  Eigen::Vector4d nearest(const Twist& command_W);
  double largestScale(const Eigen::Vector3d& v_W, double s, double tolerance) const;
  double stoppingScale(const Twist& twist_W, double s, const BrakingLimits& limits, double tolerance) const;

  std::vector<ClosingRow> rows_;
  std::vector<HalfSpace4> half_spaces_;
};

/// Returns the part of a command that leads out: the command, scaled down until no tool point is faster than
/// `escape_speed` or can not stop before what no plane stands for; zero unless every gap has grown when the tool is at rest,
/// also if surfaces come and the tool turns.
/// @throws InvalidInput  if a value is NaN or out of range
Twist escapeVelocity(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
                     const BrakingLimits& limits, double escape_speed);

}  // namespace sweep_guard_core
