#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "soundness/ccd_queries.h"
#include "soundness/checks.h"
#include "soundness/pairs.h"
#include "soundness/positives.h"
#include "soundness/sampled_sweep.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/time_of_impact.h"

namespace sweep_guard_core::soundness {
namespace {

constexpr std::uint64_t kPairsForASweep = 100;  // a whole sweep has 1 600 triangles

void makeCases(std::uint64_t cases) {
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    std::cout << textOf(randomPairs(seed), "random") << textOf(grazingPairs(seed), "grazing")
              << textOf(adversarialPairs(seed), "adversarial") << textOf(constructedPositives(seed), "positives");
    if (seed % kPairsForASweep == 0) std::cout << textOf(randomWholeSweep(seed), "sweeps");
  }
}

std::string textOf(const TriangleSet& triangles) {
  std::string text;
  for (const std::uint32_t triangle : triangles) text += ' ' + std::to_string(triangle);
  return text + '\n';
}

std::string textOf(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", time);
  return text;
}

void answer(const PairCase& pair, const std::string& about, std::vector<TestedDetector>& detectors) {
  const TriangleMesh mesh_M = pair.triangles.mesh();
  for (TestedDetector& tested : detectors) {
    std::cout << about << ' ' << tested.name << " triangles"
              << textOf(tested.detector->detect(mesh_M, pair.swept_M).triangles);
  }
}

void answer(const SweepCase& sweep, const std::string& about, std::vector<TestedDetector>& detectors) {
  for (TestedDetector& tested : detectors) {
    for (const VolumeKind kind : volumeKinds()) {
      SweepCase of_kind = sweep;
      of_kind.options.volume = kind;
      const SweepResult result = checkCase(*tested.detector, of_kind);
      const std::string line = about + ' ' + tested.name + '/' + nameOf(kind);
      std::cout << line << " triangles" << textOf(result.triangles) << line << " not_ruled_out"
                << textOf(result.not_ruled_out) << line << " times";
      for (const TriangleContact& contact : result.in_contact) {
        std::cout << ' ' << contact.triangle << ':' << textOf(contact.impact.time_of_impact);
      }
      std::cout << '\n';
    }
  }
}

void answerCcdQueries(const std::string& file) {
  std::ifstream stream(file);
  const bool edges = file.find("edge-edge") != std::string::npos;
  const ConvexShape point = ConvexShape::hull({Eigen::Vector3d::Zero()});
  size_t index = 0;
  for (const CcdQuery& query :
       readCcdQueries(stream, edges ? CcdQuery::Kind::kEdgeEdge : CcdQuery::Kind::kVertexFace)) {
    const RelativeQuery seen = relative(query);
    std::cout << file << '#' << ++index << " narrow_phase times";
    for (size_t i = 0; i < seen.triangles.size(); ++i) {
      const auto impact = timeOfImpact(point, {Motion{}}, seen.triangles[i], seen.rounding);
      if (impact) std::cout << ' ' << i << ':' << textOf(impact->time_of_impact);
    }
    std::cout << '\n';
  }
}

void answerCases(const std::string& file, std::vector<TestedDetector>& detectors) {
  std::ifstream stream(file);
  if (!stream) throw InvalidInput(file + ": cannot read");
  size_t index = 0;
  while (const std::optional<AnyCase> any = readCase(stream)) {
    const std::string about = file + '#' + std::to_string(++index);
    if (any->pair) answer(*any->pair, about, detectors);
    if (any->sweep) answer(*any->sweep, about, detectors);
  }
}

void answerAll(const std::vector<std::string>& files) {
  std::vector<TestedDetector> detectors = allDetectors();
  for (const std::string& file : files) {
    if (file.size() > 4 && file.substr(file.size() - 4) == ".csv") {
      answerCcdQueries(file);
    } else {
      answerCases(file, detectors);
    }
  }
}

}  // namespace
}  // namespace sweep_guard_core::soundness

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || (arguments[0][0] == '-' && (arguments[0] != "--make" || arguments.size() != 2))) {
    std::cerr << "usage: answers --make N | answers FILE...\n"
                 "Writes N cases of each kind; or the triangles and times of impact that each detector finds in the\n"
                 "cases of files, or of Sample-Queries (.csv), to be compared with those of another machine.\n";
    return 2;
  }
  try {
    if (arguments[0] == "--make") {
      sweep_guard_core::soundness::makeCases(std::stoull(arguments[1]));
    } else {
      sweep_guard_core::soundness::answerAll(arguments);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "answers: " << error.what() << '\n';
    return 2;
  }
}
