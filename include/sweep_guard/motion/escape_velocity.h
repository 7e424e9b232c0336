#pragma once

#include <vector>

#include "sweep_guard/motion/braking.h"

namespace sweep_guard_core {

/// Returns the part of a command that leads out: the command, scaled down until no tool point is faster than
/// `escape_speed` or can not stop before what no plane stands for; zero unless every gap grows, also if surfaces come and
/// the tool turns.
/// @throws InvalidInput  if a value is NaN or out of range
Twist escapeVelocity(const Twist& command_W, const std::vector<FacingBall>& facing, const UncoveredSurfaces& uncovered,
                     const BrakingLimits& limits, double escape_speed);

}  // namespace sweep_guard_core
