#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <variant>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Velocity of a tool: of the origin of its frame [m/s], then its turn rate [rad/s], both along the same axes.
struct CommandedTwist {
  Vector6d twist = Vector6d::Zero();
  bool of_tool = false;  ///< along the axes of T, which turn with it; false: of W
};

/// Velocities of the variables of a robot [rad/s or m/s]; NaN: of a joint that nothing is commanded for.
struct CommandedJoints {
  std::vector<double> velocities;
};

/// What goes to a robot at one time: where the tool shall be (X_WT), how it or its joints shall move until the next command.
struct SentCommand {
  Time stamp;
  std::variant<Eigen::Isometry3d, CommandedTwist, CommandedJoints> value;
};

}  // namespace sweep_guard_core
