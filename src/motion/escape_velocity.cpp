#include "sweep_guard/motion/escape_velocity.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

// A turn may also close a gap by its second order, until the next command.
bool opens(const FacingBall& ball, const Twist& twist_W, const BrakingLimits& limits) {
  const double turned = 0.5 * limits.tool_radius * twist_W.w_W.squaredNorm() * limits.reaction_time;
  return closingSpeed(ball, twist_W) + std::max(0.0, ball.surface_speed) + turned < 0.0;
}

}  // namespace

Twist escapeVelocity(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
                     const BrakingLimits& limits, double escape_speed) {
  requireUsable(command_W);
  requireUsable(limits);
  requireUsable(uncovered);
  for (const FacingBall& ball : facing) requireUsable(ball);
  const double fastest = fastestPoint(command_W, limits.tool_radius);
  const double allowed = std::min(escape_speed, allowedSpeed(uncovered, limits));
  const double scale = fastest > allowed ? allowed / fastest : 1.0;
  const Twist escape_W{scale * command_W.v_W, scale * command_W.w_W};
  const bool all_grow =
      std::all_of(facing.begin(), facing.end(), [&](const FacingBall& ball) { return opens(ball, escape_W, limits); });
  return all_grow ? escape_W : Twist{};
}

}  // namespace sweep_guard_core
