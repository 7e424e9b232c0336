#include "evaluation/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "common/csv.h"
#include "evaluation/option_values.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

namespace po = boost::program_options;
using sweep_guard_core::csvNumber;
using sweep_guard_core::InvalidInput;

namespace {

constexpr double kMaxHorizon = 10.0;  // [s]
const sweep_guard_core::WarningThresholds kThresholds;

po::options_description outputOptions(Options& options) {
  po::options_description described("Results to compute and write; by default all results are computed and printed");
  described.add_options()("csv", text(options.csv, "FILE"), "prediction errors")(
      "warnings-csv", text(options.warnings_csv, "FILE"), "leads and false alarms of the warnings")(
      "tradeoff-csv", text(options.tradeoff_csv, "FILE"), "contacts warned of and false alarms, for all thresholds")(
      "sessions", po::bool_switch(&options.sessions), "alarms in sessions beside fixed sheets")(
      "sessions-csv", text(options.sessions_csv, "FILE"), "figures of the sessions")(
      "sessions-objects-csv", text(options.sessions_objects_csv, "FILE"), "counts of every sheet of every session")(
      "compare-sessions", text(options.compare_sessions, "FILE"),
      "compares the sessions with those of an earlier --sessions-objects-csv")(
      "calibration", po::bool_switch(&options.calibration),
      "how often the contacts came that the guard predicts with a probability, beside the objects of the sessions")(
      "calibration-csv", text(options.calibration_csv, "FILE"), "the same in ten equal bins");
  return described;
}

po::options_description predictionOptions(Options& options) {
  po::options_description described("Prediction");
  described.add_options()("help,h", po::bool_switch(&options.help), "print this text")(
      "predictors", withDefault(fmt::format("{}", fmt::join(sweep_guard_core::predictorNames(), ",")), "NAMES"),
      "predictors to compare; `command` is `direct` that is told what goes to the robot")(
      "command", text(options.command, "TOPIC"),
      "topic of what goes to the robot in rosbags, poses; adds the predictor `command`")(
      "plant", po::value<std::string>()->value_name("S,S"),
      "a robot to which the recordings go: dead time and lag [s]; adds the predictor `command`")(
      "topic", text(options.topic, "NAME"), "topic of the poses in rosbags; required if there are several")(
      "horizons", withDefault("0.1,0.2,0.5,1", "S,S,..."), "horizons of the prediction errors [s]")(
      "degree", withDefault("1", "N"),
      "`polynomial` only: degree, 0 to 5; one for all axes, or six for x,y,z and the rotations")(
      "window", withDefault("0.3", "S"), "`polynomial` only: ignores older poses [s]")(
      "forgetting-factor", withDefault("0.98", "F"),
      "`polynomial` only: weight of a pose relative to the next pose, in (0, 1]");
  return described;
}

po::options_description warningOptions(const Options& options) {
  po::options_description described("Warnings");
  described.add_options()("placements", withDefault("80", "N"),
                          "obstacles along each recording; the tool runs into half of them and misses the others")(
      "seed", withDefault("1", "N"), "seed of the placements")("tool-radius", withDefault("0.005", "M"),
                                                               "radius of the tool, a cylinder [m]")(
      "tool-length", withDefault("0.1", "M"), "length of the tool [m]")(
      "min-probability", withDefault(csvNumber(options.min_probability), "P"),
      "smallest probability of meeting the plane of a triangle that raises a warning, in (0, 1]")(
      "hold-time", withDefault("0.5", "S"), "a warning stays for this time after its cause is over [s]")(
      "up-to", withDefault("20", "N"), "end of the average of the trade-off [false alarms per minute]");
  return described;
}

po::options_description sessionOptions(Options& options) {
  po::options_description described("Sessions");
  described.add_options()("sheets", withDefault("20", "N"), "sheets in each session")(
      "session-count", withDefault("5", "N"), "sessions of each recording; the first has the seed of --seed")(
      "mesh", po::value(&options.meshes)->value_name("FILE"),
      "STL, OBJ or DAE file of a mesh to place at random as the sheets are; may be repeated")(
      "fixed-mesh", po::value(&options.fixed_meshes)->value_name("FILE"),
      "the same, but the mesh stays where its coordinates say, in the frame of the poses")(
      "mesh-scale", withDefault("1", "M"), "unit of the mesh files [m]")(
      "considered-on", withDefault(csvNumber(kThresholds.considered_on), "P"),
      "smallest probability that raises CONSIDERED, in (0, 1]")(
      "considered-off", withDefault(csvNumber(kThresholds.considered_off), "P"),
      "smallest probability that keeps CONSIDERED up, in (0, 1]")(
      "reflex-probability", withDefault(csvNumber(kThresholds.reflex), "P"),
      "smallest probability that raises REFLEX, in (0, 1]; --min-probability sets these three")(
      "tune", po::value<std::string>()->value_name("N"),
      "finds the thresholds for at most N unjustified alarms per minute and prints them as yaml")(
      "tune-csv", text(options.tune_csv, "FILE"), "with --tune: what each threshold gives");
  return described;
}

RobotOptions toPlant(const std::string& list) {
  const std::vector<std::string> words = splitAtCommas(list);
  if (words.size() != 2) throw InvalidInput("--plant takes two numbers: dead time and lag");
  RobotOptions plant;
  plant.dead_time = sweep_guard_core::fromSeconds(toNumber("plant", words[0], 0.0, 1.0));
  plant.lag = sweep_guard_core::fromSeconds(toNumber("plant", words[1], 0.0, 1.0));
  return plant;
}

std::vector<std::string> toPredictors(const std::string& list, bool commands) {
  std::vector<std::string> known = sweep_guard_core::predictorNames();
  if (commands) known.emplace_back(kCommandPredictor);
  std::vector<std::string> names;
  for (const std::string& name : splitAtCommas(list)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InvalidInput(fmt::format("--predictors: '{}' must be one of {}", name, fmt::join(known, ",")));
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<sweep_guard_core::Duration> toHorizons(const std::string& list) {
  std::vector<sweep_guard_core::Duration> horizons;
  for (const std::string& word : splitAtCommas(list)) {
    horizons.push_back(sweep_guard_core::fromSeconds(toNumber("horizons", word, 1e-3, kMaxHorizon)));
  }
  std::sort(horizons.begin(), horizons.end());
  horizons.erase(std::unique(horizons.begin(), horizons.end()), horizons.end());
  return horizons;
}

std::array<int, 6> toDegrees(const std::string& list) {
  const std::vector<std::string> words = splitAtCommas(list);
  std::array<int, 6> degrees{};
  if (words.size() != 1 && words.size() != degrees.size()) throw InvalidInput("--degree takes one number or six");
  for (size_t axis = 0; axis < degrees.size(); ++axis) {
    degrees[axis] = toNumber("degree", words.size() == 1 ? words.front() : words[axis], 0, 5);
  }
  return degrees;
}

// Checks the texts of the options, and stores what they say.
void store(const po::variables_map& values, Options& options) {
  const auto word = [&](const char* option) { return values[option].as<std::string>(); };
  const auto number = [&](const char* option, auto lower, auto upper) {
    return toNumber(option, word(option), lower, upper);
  };
  const auto seconds = [&](const char* option, double lower, double upper) {
    return sweep_guard_core::fromSeconds(number(option, lower, upper));
  };
  if (values.count("plant") != 0) options.plant = toPlant(word("plant"));
  options.predictors = toPredictors(word("predictors"), options.hasCommands());
  if (options.hasCommands() && values["predictors"].defaulted()) options.predictors.emplace_back(kCommandPredictor);
  options.horizons = toHorizons(word("horizons"));
  options.predictor.degree = toDegrees(word("degree"));
  options.predictor.window = seconds("window", 1e-3, 60.0);
  options.predictor.forgetting_factor = number("forgetting-factor", 1e-3, 1.0);
  options.placements = number("placements", size_t{1}, size_t{100000});
  options.seed = number("seed", std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max());
  options.simulation.tool =
      sweep_guard_core::ConvexShape::cylinder(number("tool-radius", 1e-6, 100.0), number("tool-length", 1e-6, 100.0));
  options.min_probability = number("min-probability", 1e-3, 1.0);
  options.simulation.limits.hold_time = seconds("hold-time", 0.0, 60.0);
  options.max_false_alarms = number("up-to", 1e-3, 1e6);
  if (values["min-probability"].defaulted()) {
    options.session_thresholds = {number("reflex-probability", 1e-3, 1.0), number("considered-on", 1e-3, 1.0),
                                  number("considered-off", 1e-3, 1.0)};
  } else {
    options.session_thresholds = sweep_guard_core::WarningThresholds::ofMinProbability(options.min_probability);
  }
  if (options.session_thresholds.considered_off > options.session_thresholds.considered_on) {
    throw InvalidInput("--considered-off: must be at most --considered-on");
  }
  if (values.count("tune") != 0) options.tune = number("tune", 0.0, 1e6);
  if (!options.tune && !options.tune_csv.empty()) throw InvalidInput("--tune-csv: needs --tune");
  options.session.sheets = number("sheets", size_t{0}, size_t{10000});
  options.session.sessions = number("session-count", size_t{1}, size_t{1000});
  options.session.seed = options.seed;
  options.mesh_scale = number("mesh-scale", 1e-6, 1e6);
  if (options.wantsSessions() && options.session.sheets + options.meshes.size() + options.fixed_meshes.size() == 0) {
    throw InvalidInput("--sheets: sessions need a sheet or a mesh");
  }
  if (values["predictors"].defaulted()) {
    options.session_predictor =
        options.hasCommands() ? kCommandPredictor : sweep_guard_core::PredictorOptions{}.predictor;
  } else {
    options.session_predictor = options.predictors.front();
  }
}

}  // namespace

std::string usage() {
  Options options;
  std::ostringstream text;
  text << "Usage: evaluate_prediction [options] FILE...\n\n"
          "Measures how well recorded motions are predicted, and how early and how often the guard warns. FILE is a\n"
          "motion file (lines `stamp tx ty tz qx qy qz qw` in s and m) or a rosbag with geometry_msgs/PoseStamped or\n"
          "TransformStamped. Prints tables of the results. `rosrun sweep_guard plot.py FILE.csv FILE.png` draws what\n"
          "it writes for --csv, --tradeoff-csv, --sessions-csv, --tune-csv and --calibration-csv.\n\n"
       << outputOptions(options) << '\n'
       << predictionOptions(options) << '\n'
       << warningOptions(options) << '\n'
       << sessionOptions(options);
  return text.str();
}

Options parseOptions(int argc, const char* const* argv) {
  Options options;
  po::options_description all;
  all.add(outputOptions(options))
      .add(predictionOptions(options))
      .add(warningOptions(options))
      .add(sessionOptions(options));
  const po::variables_map values = parseCommandLine(argc, argv, all, options.files);
  store(values, options);
  if (options.files.empty() && !options.help) throw InvalidInput("no recording; --help shows the usage");
  return options;
}

}  // namespace sweep_guard_evaluation
