#pragma once

#include <string>
#include <vector>

#include "evaluation/delayed_guard.h"
#include "evaluation/simulated_robot.h"

namespace sweep_guard_evaluation {

/// Options of the program.
struct ClosedLoopOptions {
  bool help = false;
  std::vector<std::string> files;  ///< at least one
  std::string topic;               ///< of the rosbags; empty: the only topic with poses
  std::string csv;                 ///< file to write; empty: none
  sweep_guard_core::ConvexShape shape = sweep_guard_core::ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1);
  sweep_guard_core::Tool tool{shape};  ///< of this shape, in one or more pieces
  RobotOptions robot;
  DelayedGuardOptions guard;   ///< its delays of the robot are replaced by those of `robot`
  size_t random_retreats = 4;  ///< of each kind, from each place where the guard held the tool
  size_t placements = 80;      ///< along each recording
  std::uint64_t seed = 1;      ///< of the placements
};

/// Returns the text of --help.
std::string closedLoopUsage();

/// Parses the command line.
/// @throws sweep_guard_core::InvalidInput that names an option that is unknown, lacks its value or is out of range
ClosedLoopOptions parseClosedLoopOptions(int argc, const char* const* argv);

}  // namespace sweep_guard_evaluation
