#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/nearest_point.h"
#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_core {

/// Limits the part of a commanded velocity that closes on surfaces. Keeps its buffers between calls.
class VelocityLimiter {
 public:
  /// @param balls  limit() allocates nothing for at most this many
  explicit VelocityLimiter(size_t balls);

  /// Returns the velocity nearest to the command that closes on no plane faster than closingLimit(): with v' and w' = s
  /// w, s in [0, 1], for which |v' - v|^2 / |v|^2 + (1 - s)^2 is smallest. If v' or any tool point is then too fast, that
  /// is faster than v, or than can stop before what no plane stands for, both parts are scaled down. So where nothing
  /// closes too fast the command is returned as it is, nothing moves that was not commanded, and zero always remains.
  /// Closing speeds are exact to 1e-11 of the commanded speed of the fastest tool point; between planes that differ by
  /// 1e-8 rad or less from parallel or opposite, to 1.5e-6.
  /// @throws InvalidInput  if the command, a ball or a limit is not finite or out of range
  Twist limit(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
              const BrakingLimits& limits);

 private:
  // The tool's own motion closes on the plane of one ball by -normal_W · v' + turning s [m/s], which must be <= limit.
  struct Row {
    Eigen::Vector3d normal_W;
    double turning;
    double limit;

    double closing(const Eigen::Vector3d& v_W, double s) const { return turning * s - normal_W.dot(v_W); }
  };

  void collectRows(const Twist& command_W, const std::vector<FacingBall>& facing, const BrakingLimits& limits);
  void collectHalfSpaces(double speed);
  Eigen::Vector4d nearest(const Twist& command_W);
  double largestScale(const Eigen::Vector3d& v_W, double s, double tolerance) const;

  std::vector<Row> rows_;
  std::vector<HalfSpace4> half_spaces_;
};

/// Returns the part of a command that leads out: the command, scaled down until no tool point is faster than
/// `escape_speed` or can not stop before what no plane stands for; zero unless every gap grows, also if surfaces come and
/// the tool turns.
/// @throws InvalidInput  if a value is NaN or out of range
Twist escapeVelocity(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
                     const BrakingLimits& limits, double escape_speed);

}  // namespace sweep_guard_core
