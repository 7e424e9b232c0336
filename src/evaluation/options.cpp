#include "evaluation/options.h"

#include <algorithm>
#include <boost/program_options.hpp>
#include <charconv>
#include <sstream>
#include <system_error>

#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

namespace po = boost::program_options;
using sweep_guard::InvalidInput;

namespace {

constexpr double kLongestHorizon = 10.0;  // [s]

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

/// The words that --help shows, and the variables that the values go to.
struct Words {
  std::string predictors = joined(sweep_guard::predictorNames());
  std::string horizons = "0.1,0.2,0.5,1";
  std::string degree = "1";
  std::string window = "0.3";
  std::string forgetting_factor = "0.98";
};

po::options_description described(Options& options, Words& words) {
  po::options_description described("Options");
  const auto text = [](std::string& variable, const char* name) { return po::value(&variable)->value_name(name); };
  described.add_options()("help,h", po::bool_switch(&options.help), "say this")(
      "predictors", text(words.predictors, "NAMES")->default_value(words.predictors), "to compare")(
      "topic", text(options.topic, "NAME"), "of the poses in rosbags; needed where there are several")(
      "horizons", text(words.horizons, "S,S,...")->default_value(words.horizons), "how far ahead errors are taken [s]")(
      "csv", text(options.csv, "FILE"), "write the errors ahead")("plot", text(options.plot, "FILE.png"),
                                                                  "draw error against horizon")(
      "degree", text(words.degree, "N")->default_value(words.degree),
      "of `polynomial`: 0 to 5; one for all axes, or six for x,y,z and the rotations")(
      "window", text(words.window, "S")->default_value(words.window), "of `polynomial`: no older pose counts [s]")(
      "forgetting-factor", text(words.forgetting_factor, "F")->default_value(words.forgetting_factor),
      "of `polynomial`: weight of a pose over that of the next one, in (0, 1]");
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

std::vector<std::string> toPredictors(const std::string& list) {
  const std::vector<std::string>& known = sweep_guard::predictorNames();
  std::vector<std::string> names;
  for (const std::string& name : splitAtCommas(list)) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw InvalidInput("--predictors: '" + name + "' is none of " + joined(known));
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<sweep_guard::Duration> toHorizons(const std::string& list) {
  std::vector<sweep_guard::Duration> horizons;
  for (const std::string& word : splitAtCommas(list)) {
    horizons.push_back(sweep_guard::fromSeconds(toNumber("horizons", word, 1e-3, kLongestHorizon)));
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
    const std::string& word = words.size() == 1 ? words.front() : words[axis];
    const double degree = toNumber("degree", word, 0.0, 5.0);
    degrees[axis] = static_cast<int>(degree);
    if (degrees[axis] != degree) throw InvalidInput("--degree: '" + word + "' is not a whole number");
  }
  return degrees;
}

}  // namespace

std::string usage() {
  Options options;
  Words words;
  std::ostringstream text;
  text
      << "Usage: evaluate_prediction [options] FILE...\n\n"
         "How well the motions in FILE... are predicted: motion files (lines `stamp tx ty tz qx qy qz qw` in s and m)\n"
         "and rosbags of geometry_msgs/PoseStamped or TransformStamped. Prints tables, and writes what it is asked "
         "for.\n\n"
      << described(options, words);
  return text.str();
}

Options parseOptions(int argc, const char* const* argv) {
  Options options;
  Words words;
  po::options_description all = described(options, words);
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
  options.predictors = toPredictors(words.predictors);
  options.horizons = toHorizons(words.horizons);
  options.predictor.degree = toDegrees(words.degree);
  options.predictor.window = sweep_guard::fromSeconds(toNumber("window", words.window, 1e-3, 60.0));
  options.predictor.forgetting_factor = toNumber("forgetting-factor", words.forgetting_factor, 1e-3, 1.0);
  if (options.files.empty() && !options.help) throw InvalidInput("no recording is given; --help says how");
  return options;
}

}  // namespace sweep_guard_evaluation
