#pragma once

#include <sweep_guard/ToolBalls.h>

#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Returns the pieces of all bodies of the tool as balls, without stamp and revision. Balls of a body that moves with the
/// root of the robot are in the tool frame.
sweep_guard::ToolBalls toolBallsMsg(const Parameters& parameters);

}  // namespace sweep_guard_ros
