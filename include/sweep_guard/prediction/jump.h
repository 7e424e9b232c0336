#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <string>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// How far something has moved.
struct Moved {
  double distance = 0.0;  ///< [m], >= 0
  double turn = 0.0;      ///< [rad], >= 0
};

/// Returns how far a frame has moved from one pose to another; its turn is the smaller one.
Moved movedBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);

/// The fastest motion that is believed.
struct SpeedLimits {
  double max_speed = std::numeric_limits<double>::infinity();      ///< [m/s], > 0
  double max_turn_rate = std::numeric_limits<double>::infinity();  ///< [rad/s], > 0
};

/// A speed that is not believed.
struct JumpSpeed {
  double speed = 0.0;  ///< [m/s], or [rad/s] if it turns
  bool turns = false;
};

/// Returns the speed of a motion that is a jump, that of the translation or of the rotation, whichever exceeds its
/// limit by more; empty: it is none. A jump is faster than a limit over at least 20 ms, and at least 20 mm or 0.1 rad
/// long: stamps may be wrong by some milliseconds.
/// @param within  time that the motion took, >= 0
std::optional<JumpSpeed> jumpSpeed(const Moved& moved, Duration within, const SpeedLimits& limits);

/// How far the motion before a pose is looked back at.
constexpr Duration kJumpTime = std::chrono::milliseconds(20);

/// Returns the jump that the last step of a motion makes. The step is faster than a limit by its own stamps and over at
/// least 20 ms; alone, or together with the motion before it, because a jump may come in parts and a burst of stamps is
/// none.
/// @param longer  returns the Moved since a time that is kJumpTime before the end of the step, if possible, and how long that is
template <typename Longer>
std::optional<JumpSpeed> jumpOfStep(const Moved& step, Duration within, const SpeedLimits& limits,
                                    const Longer& longer) {
  const double seconds = toSeconds(within);
  if (step.distance <= limits.max_speed * seconds && step.turn <= limits.max_turn_rate * seconds) return std::nullopt;
  if (const auto jump = jumpSpeed(step, within, limits)) return jump;
  const auto [moved, since] = longer();
  return jumpSpeed(moved, since, limits);
}

/// Returns a speed with its unit, as in "130 rad/s".
std::string inWords(const JumpSpeed& speed);

}  // namespace sweep_guard_core
