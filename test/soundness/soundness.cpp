#include <algorithm>
#include <boost/program_options.hpp>
#include <fstream>
#include <iostream>

#include "soundness/families.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

namespace options = boost::program_options;

options::options_description description() {
  options::options_description all(
      "Searches for triangles that a moving tool meets and a detector does not name.\n"
      "Exit status: 0 nothing found, 1 a failure, 2 wrong usage. Options");
  auto add = all.add_options();
  add("help", "print this text");
  add("cases", options::value<double>()->default_value(1000), "number of cases of each family, for each detector");
  add("seed", options::value<std::uint64_t>()->default_value(1), "the same seed gives the same cases");
  add("family", options::value<std::vector<std::string>>()->multitoken(), "one or more; default: all");
  add("detector", options::value<std::vector<std::string>>()->multitoken(), "one or more; default: all");
  add("part", options::value<std::string>()->default_value("0/1"), "I/N: every N-th seed, from I on");
  add("replay", options::value<std::string>(), "FILE, or - for standard input: check its cases again");
  return all;
}

Extent extentOf(const options::variables_map& given) {
  Extent extent;
  const double cases = given["cases"].as<double>();
  if (!(cases >= 1.0 && cases <= 1e12)) throw InvalidInput("--cases: from 1 to 1e12");
  extent.cases = static_cast<std::uint64_t>(cases);
  extent.seed = given["seed"].as<std::uint64_t>();
  std::istringstream part(given["part"].as<std::string>());
  char slash = ' ';
  if (!(part >> extent.part >> slash >> extent.parts) || slash != '/' || extent.part >= extent.parts) {
    throw InvalidInput("--part: I/N with I below N");
  }
  return extent;
}

bool wanted(const options::variables_map& given, const std::string& option, const std::string& name) {
  if (given.count(option) == 0) return true;
  const auto& names = given[option].as<std::vector<std::string>>();
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string knownFamilies() {
  std::string known;
  for (const Family& family : families()) known += "\n  " + family.name + ": " + family.meaning;
  return known;
}

void refuseUnknownFamilies(const options::variables_map& given) {
  if (given.count("family") == 0) return;
  for (const std::string& name : given["family"].as<std::vector<std::string>>()) {
    const auto& all = families();
    if (std::none_of(all.begin(), all.end(), [&](const Family& family) { return family.name == name; })) {
      throw InvalidInput("--family: '" + name + "' is unknown; known are" + knownFamilies());
    }
  }
}

void replayFrom(const std::string& name, std::vector<TestedDetector>& detectors, Report& report) {
  std::ifstream file;
  if (name != "-") {
    file.open(name);
    if (!file) throw InvalidInput("--replay: cannot read " + name);
  }
  std::istream& stream = name == "-" ? std::cin : file;
  while (const std::optional<AnyCase> any = readCase(stream)) replay(*any, detectors, report);
}

int search(int argc, char** argv) {
  const options::options_description known = description();
  options::variables_map given;
  options::store(options::parse_command_line(argc, argv, known), given);
  options::notify(given);
  if (given.count("help") != 0) {
    std::cout << known;
    return 0;
  }
  refuseUnknownFamilies(given);
  const Extent extent = extentOf(given);
  std::vector<TestedDetector> detectors = allDetectors();
  detectors.erase(std::remove_if(detectors.begin(), detectors.end(),
                                 [&](const TestedDetector& tested) { return !wanted(given, "detector", tested.name); }),
                  detectors.end());
  if (detectors.empty()) throw InvalidInput("--detector: unknown");

  Report report(std::cout);
  if (given.count("replay") != 0) {
    replayFrom(given["replay"].as<std::string>(), detectors, report);
  } else {
    std::cout << "seed " << extent.seed << std::endl;
    for (const Family& family : families()) {
      if (wanted(given, "family", family.name)) run(family, extent, detectors, report);
    }
  }
  report.summarize();
  return report.failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_core::soundness

int main(int argc, char** argv) {
  try {
    return sweep_guard_core::soundness::search(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "soundness: " << error.what() << '\n';
    return 2;
  }
}
