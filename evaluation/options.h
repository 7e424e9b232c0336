#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/obstacle_placement.h"
#include "evaluation/session_objects.h"
#include "evaluation/simulate_guard.h"
#include "evaluation/simulated_robot.h"

namespace sweep_guard_evaluation {

/// Name of the predictor `direct` that is told what goes to the robot.
constexpr const char* kCommandPredictor = "command";

/// Options of the program.
struct Options {
  bool help = false;
  std::vector<std::string> files;     ///< at least one
  std::string topic;                  ///< of the rosbags; empty: the only topic with poses
  std::string command;                ///< topic of what goes to the robot; empty: none
  std::optional<RobotOptions> plant;  ///< dead time and lag of a robot that the recordings go to; empty: none

  std::vector<std::string> predictors;               ///< at least one, each once
  std::vector<sweep_guard_core::Duration> horizons;  ///< ascending, > 0
  sweep_guard_core::PredictorOptions predictor;      ///< its name is not used; see predictors

  size_t placements = 80;             ///< obstacles along each recording
  std::uint64_t seed = 1;             ///< of the placements
  GuardSimulationOptions simulation;  ///< its predictor and thresholds are not used
  std::string session_predictor;      ///< the first one asked for, or the guard's default
  sweep_guard_core::WarningThresholds session_thresholds;
  SessionOptions session;                 ///< its meshes are read from these files
  std::vector<std::string> meshes;        ///< files of meshes to place at random
  std::vector<std::string> fixed_meshes;  ///< files of meshes that stay where their coordinates say
  double mesh_scale = 1.0;                ///< unit of the mesh files [m]
  double min_probability = 0.1;           ///< of the warnings beside the squares, in (0, 1]
  double max_false_alarms = 20.0;         ///< per minute; end of the average of the trade-off

  std::string csv;  ///< files to write; empty: none
  std::string warnings_csv;
  std::string tradeoff_csv;
  bool sessions = false;  ///< print the table of the sessions
  std::string sessions_csv;
  std::string sessions_objects_csv;
  std::optional<double> tune;  ///< wanted unjustified alarms per minute
  std::string tune_csv;
  bool calibration = false;  ///< print the calibration of the probabilities
  std::string calibration_csv;
  std::string compare_sessions;  ///< file to read: a sessions_objects_csv

  bool hasCommands() const { return plant || !command.empty(); }
  bool wantsNothing() const { return csv.empty() && warnings_csv.empty() && tradeoff_csv.empty() && !wantsSessions(); }
  bool wantsSessions() const {
    return sessions || !sessions_csv.empty() || !sessions_objects_csv.empty() || tune || !compare_sessions.empty() ||
           wantsCalibration();
  }
  bool wantsCalibration() const { return calibration || !calibration_csv.empty(); }
  bool wantsErrors() const { return !csv.empty() || wantsNothing(); }
  bool wantsTradeoff() const { return !tradeoff_csv.empty(); }
  bool wantsWarnings() const { return !warnings_csv.empty() || wantsTradeoff() || wantsNothing(); }
};

/// Returns the text of --help.
std::string usage();

/// Parses the command line.
/// @throws sweep_guard_core::InvalidInput that names an option that is unknown, lacks its value or is out of range
Options parseOptions(int argc, const char* const* argv);

}  // namespace sweep_guard_evaluation
