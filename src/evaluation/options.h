#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_evaluation {

/// What the program is asked to do.
struct Options {
  bool help = false;
  std::vector<std::string> files;  ///< at least one
  std::string topic;               ///< of the rosbags; empty: the only one with poses

  std::vector<std::string> predictors;          ///< at least one, each once
  std::vector<sweep_guard::Duration> horizons;  ///< ascending, > 0
  sweep_guard::PredictorOptions predictor;      ///< but for its name

  std::string csv;  ///< files to write; empty: not asked for
  std::string plot;
};

/// What --help prints.
std::string usage();

/// @throws sweep_guard::InvalidInput naming the option that is unknown, lacks its value or is out of range
Options parseOptions(int argc, const char* const* argv);

}  // namespace sweep_guard_evaluation
