#pragma once

#include "scenes.h"
#include "sweep_guard/kinematics/robot_motion.h"

namespace sweep_guard_core {

/// Returns a tree without limits: links in a row, or, if it has branches, each below any link before it. Of six joints, one
/// is fixed, one prismatic and one mimics another one on average; the others are revolute. The first is revolute.
KinematicTree randomRobot(Random& random, size_t joints, bool branches);

/// Returns a state in which each variable is within `reach` [rad or m] of 0 and the root within 1 m of the origin.
RobotState randomState(Random& random, const KinematicTree& tree, double reach);

/// Returns a state that differs from another one in each variable by at most `reach`, and by as much of a turn [rad] and a
/// way [m] of the root.
RobotState randomStateNear(Random& random, const RobotState& state, double reach);

}  // namespace sweep_guard_core
