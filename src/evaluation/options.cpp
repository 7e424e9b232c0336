#include "evaluation/options.h"

#include <algorithm>
#include <boost/program_options.hpp>
#include <charconv>
#include <limits>
#include <sstream>
#include <system_error>

#include "evaluation/csv.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

namespace po = boost::program_options;
using sweep_guard_core::InvalidInput;

namespace {

constexpr double kMaxHorizon = 10.0;  // [s]

std::string joined(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ",") + word;
  return list;
}

std::vector<std::string> splitAtCommas(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list + ',');
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

/// What stands behind the options, until it is checked.
struct Words {
  std::string predictors = joined(sweep_guard_core::predictorNames());
  std::string horizons = "0.1,0.2,0.5,1";
  std::string degree = "1";
  std::string window = "0.3";
  std::string forgetting_factor = "0.98";
  std::string tool_radius = "0.005";
  std::string tool_length = "0.1";
  std::string placements = "80";
  std::string seed = "1";
  std::string min_probability = csvNumber(sweep_guard_core::WarningLimits{}.min_probability);
  std::string hold_time = "0.5";
  std::string most_false_alarms = "20";
};

auto text(std::string& word, const char* name) { return po::value(&word)->value_name(name); }
auto withDefault(std::string& word, const char* name) { return text(word, name)->default_value(word); }

po::options_description outputOptions(Options& options) {
  po::options_description described(
      "What to compute and write; without any of these everything is computed and printed");
  described.add_options()("csv", text(options.csv, "FILE"), "errors ahead")("plot", text(options.plot, "FILE.png"),
                                                                            "error against horizon")(
      "warnings-csv", text(options.warnings_csv, "FILE"), "leads and false alarms of the warnings")(
      "tradeoff-csv", text(options.tradeoff_csv, "FILE"), "contacts warned of and false alarms, over all thresholds")(
      "tradeoff-plot", text(options.tradeoff_plot, "FILE.png"), "the same, drawn");
  return described;
}

po::options_description predictionOptions(Options& options, Words& words) {
  po::options_description described("Prediction");
  described.add_options()("help,h", po::bool_switch(&options.help), "say this")(
      "predictors", withDefault(words.predictors, "NAMES"), "to compare")(
      "topic", text(options.topic, "NAME"), "of the poses in rosbags; needed where there are several")(
      "horizons", withDefault(words.horizons, "S,S,..."), "how far ahead errors are taken [s]")(
      "degree", withDefault(words.degree, "N"),
      "of `polynomial`: 0 to 5; one for all axes, or six for x,y,z and the rotations")(
      "window", withDefault(words.window, "S"), "of `polynomial`: no older pose counts [s]")(
      "forgetting-factor", withDefault(words.forgetting_factor, "F"),
      "of `polynomial`: weight of a pose over that of the next one, in (0, 1]");
  return described;
}

po::options_description warningOptions(Words& words) {
  po::options_description described("Warnings");
  described.add_options()("placements", withDefault(words.placements, "N"),
                          "surfaces placed along each recording; half are run into, half are missed")(
      "seed", withDefault(words.seed, "N"), "of the placements")("tool-radius", withDefault(words.tool_radius, "M"),
                                                                 "of the tool, a cylinder [m]")(
      "tool-length", withDefault(words.tool_length, "M"), "of the tool [m]")(
      "min-probability", withDefault(words.min_probability, "P"), "of a contact that is warned of, in (0, 1]")(
      "hold-time", withDefault(words.hold_time, "S"), "a warning stays for so long after it is over [s]")(
      "up-to", withDefault(words.most_false_alarms, "N"),
      "false alarms per minute over which the trade-off is averaged");
  return described;
}

double toNumber(const std::string& option, const std::string& word, double lower, double upper) {
  double number = 0.0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, number);
  if (error == std::errc() && stop == end && number >= lower && number <= upper) return number;
  std::ostringstream message;
  message << "--" << option << ": '" << word << "' is not a number in [" << lower << ", " << upper << ']';
  throw InvalidInput(message.str());
}

template <typename Count>
Count toCount(const std::string& option, const std::string& word, Count least, Count most) {
  Count count = 0;
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, count);
  if (error == std::errc() && stop == end && count >= least && count <= most) return count;
  throw InvalidInput("--" + option + ": '" + word + "' is not a whole number from " + std::to_string(least) + " to " +
                     std::to_string(most));
}

std::vector<std::string> toPredictors(const std::string& list) {
  const std::vector<std::string>& known = sweep_guard_core::predictorNames();
  std::vector<std::string> names;
  for (const std::string& name : splitAtCommas(list)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InvalidInput("--predictors: '" + name + "' is none of " + joined(known));
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
    degrees[axis] = toCount("degree", words.size() == 1 ? words.front() : words[axis], 0, 5);
  }
  return degrees;
}

void takePrediction(const Words& words, Options& options) {
  options.predictors = toPredictors(words.predictors);
  options.horizons = toHorizons(words.horizons);
  options.predictor.degree = toDegrees(words.degree);
  options.predictor.window = sweep_guard_core::fromSeconds(toNumber("window", words.window, 1e-3, 60.0));
  options.predictor.forgetting_factor = toNumber("forgetting-factor", words.forgetting_factor, 1e-3, 1.0);
}

void takeWarnings(const Words& words, Options& options) {
  options.placement.count = toCount<size_t>("placements", words.placements, 1, 100000);
  options.placement.seed = toCount<std::uint64_t>("seed", words.seed, 0, std::numeric_limits<std::uint64_t>::max());
  options.simulation.tool = sweep_guard_core::ConvexShape::cylinder(
      toNumber("tool-radius", words.tool_radius, 1e-6, 100.0), toNumber("tool-length", words.tool_length, 1e-6, 100.0));
  options.simulation.limits.min_probability = toNumber("min-probability", words.min_probability, 1e-3, 1.0);
  options.simulation.limits.hold_time =
      sweep_guard_core::fromSeconds(toNumber("hold-time", words.hold_time, 0.0, 60.0));
  options.most_false_alarms = toNumber("up-to", words.most_false_alarms, 1e-3, 1e6);
}

}  // namespace

std::string usage() {
  Options options;
  Words words;
  std::ostringstream text;
  text << "Usage: evaluate_prediction [options] FILE...\n\n"
          "How well the motions in FILE... are predicted, and what the guard's warnings on them are worth: motion\n"
          "files (lines `stamp tx ty tz qx qy qz qw` in s and m) and rosbags of geometry_msgs/PoseStamped or\n"
          "TransformStamped. Prints tables of what it has computed.\n\n"
       << outputOptions(options) << '\n'
       << predictionOptions(options, words) << '\n'
       << warningOptions(words);
  return text.str();
}

Options parseOptions(int argc, const char* const* argv) {
  Options options;
  Words words;
  po::options_description all;
  all.add(outputOptions(options)).add(predictionOptions(options, words)).add(warningOptions(words));
  all.add_options()("file", po::value(&options.files));
  try {
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv)
                  .options(all)
                  .positional(po::positional_options_description().add("file", -1))
                  .style(po::command_line_style::default_style & ~po::command_line_style::allow_guessing)
                  .run(),
              values);
    po::notify(values);
  } catch (const po::error& error) {
    throw InvalidInput(std::string(error.what()) + "; --help lists the options");
  }
  takePrediction(words, options);
  takeWarnings(words, options);
  if (options.files.empty() && !options.help) throw InvalidInput("no recording is given; --help says how");
  return options;
}

}  // namespace sweep_guard_evaluation
