#include "sweep_guard/prediction/jump.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sweep_guard_core {
namespace {

constexpr double kLeastDistance = 0.02;  // [m]
constexpr double kLeastTurn = 0.1;       // [rad]

}  // namespace

// The turn from the Frobenius norm of R_to - R_from, which is 2 sqrt(2) sin(turn / 2).
Moved movedBetween(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const double chord = (to.linear() - from.linear()).norm() / (2.0 * std::sqrt(2.0));
  return {(to.translation() - from.translation()).norm(), 2.0 * std::asin(std::min(1.0, chord))};
}

std::optional<JumpSpeed> jumpSpeed(const Moved& moved, Duration within, const SpeedLimits& limits) {
  const double seconds = toSeconds(std::max(within, kJumpTime));
  const double speed = moved.distance / seconds;
  const double turn_rate = moved.turn / seconds;
  const bool translation_jumps = moved.distance >= kLeastDistance && speed > limits.max_speed;
  const bool turn_jumps = moved.turn >= kLeastTurn && turn_rate > limits.max_turn_rate;
  if (!translation_jumps && !turn_jumps) return std::nullopt;
  const bool turns = turn_jumps && (!translation_jumps || turn_rate / limits.max_turn_rate > speed / limits.max_speed);
  return turns ? JumpSpeed{turn_rate, true} : JumpSpeed{speed, false};
}

std::string inWords(const JumpSpeed& speed) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %s", speed.speed, speed.turns ? "rad/s" : "m/s");
  return text;
}

}  // namespace sweep_guard_core
