#pragma once

#include <string>
#include <vector>

#include "evaluation/closed_loop_episode.h"

namespace sweep_guard_evaluation {

/// Options of the program.
struct ClosedLoopOptions {
  bool help = false;
  std::vector<std::string> files;  ///< at least one
  std::string topic;               ///< of the rosbags; empty: the only topic with poses
  std::string csv;                 ///< file to write; empty: none
  ClosedLoopSetup setup;
};

/// Returns the text of --help.
std::string closedLoopUsage();

/// Parses the command line.
/// @throws sweep_guard_core::InvalidInput that names an option that is unknown, lacks its value or is out of range
ClosedLoopOptions parseClosedLoopOptions(int argc, const char* const* argv);

}  // namespace sweep_guard_evaluation
