#pragma once

#include <string>
#include <vector>

#include "evaluation/obstacle_placement.h"
#include "evaluation/simulate_guard.h"

namespace sweep_guard_evaluation {

/// What the program is asked to do.
struct Options {
  bool help = false;
  std::vector<std::string> files;  ///< at least one
  std::string topic;               ///< of the rosbags; empty: the only one with poses

  std::vector<std::string> predictors;               ///< at least one, each once
  std::vector<sweep_guard_core::Duration> horizons;  ///< ascending, > 0
  sweep_guard_core::PredictorOptions predictor;      ///< but for its name

  ObstaclePlacementOptions placement;
  GuardSimulationOptions simulation;  ///< but for its predictor and thresholds
  double most_false_alarms = 20.0;    ///< per minute; so far the trade-off is averaged

  std::string csv;  ///< files to write; empty: not asked for
  std::string plot;
  std::string warnings_csv;
  std::string tradeoff_csv;
  std::string tradeoff_plot;

  bool nothingToWrite() const {
    return csv.empty() && plot.empty() && warnings_csv.empty() && tradeoff_csv.empty() && tradeoff_plot.empty();
  }
  bool wantErrors() const { return !csv.empty() || !plot.empty() || nothingToWrite(); }
  bool wantTradeoff() const { return !tradeoff_csv.empty() || !tradeoff_plot.empty(); }
  bool wantWarnings() const { return !warnings_csv.empty() || wantTradeoff() || nothingToWrite(); }
};

/// What --help prints.
std::string usage();

/// @throws sweep_guard_core::InvalidInput naming the option that is unknown, lacks its value or is out of range
Options parseOptions(int argc, const char* const* argv);

}  // namespace sweep_guard_evaluation
