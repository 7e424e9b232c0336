// Compares the detectors with other methods for the same task, on one size of a deforming hull.
//   compare --help
// Exit status 1: one of our detectors missed a triangle, or named one beyond its stated inflation.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <optional>

#include "common/run_program.h"
#include "machine.h"
#include "peers/detector_peer.h"
#include "peers/peers.h"
#include "race.h"
#include "row.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_benchmark {
namespace {

namespace po = boost::program_options;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::quantile;

struct Options {
  size_t triangles = 1600;
  std::string csv;
  std::string peers = "all";
  size_t deformations = 0;
  Limits limits;
  bool help = false;
};

po::options_description description(Options& options) {
  po::options_description description("Options");
  description.add_options()("help,h", po::bool_switch(&options.help), "print this text")(
      "triangles", po::value(&options.triangles)->default_value(options.triangles),
      "approximate number of triangles of the hull")("csv", po::value(&options.csv)->value_name("FILE"),
                                                     "append the results to this file")(
      "peers", po::value(&options.peers)->default_value(options.peers), "all, scalar or none")(
      "deformations", po::value(&options.deformations)->default_value(0),
      "number of different deformations; 0: as many as fit into 50 MB")(
      "frames", po::value(&options.limits.frames)->default_value(options.limits.frames), "frames of each pair")(
      "seconds", po::value(&options.limits.seconds)->default_value(options.limits.seconds),
      "time limit of each pair; the first three frames are always completed");
  return description;
}

struct Method {
  std::string name;
  Entrant::Factory make;
  bool is_ours = false;
};

Method detector(const std::string& name) {
  return {name, [name](Surface& surface) { return makeDetectorPeer(name, surface); }, true};
}

// The lower limit: every position is read once.
const std::vector<Method> kMemoryReads = {{"memory read", makeMemoryRead},
                                          {"memory read fetched ahead", makeMemoryReadAhead}};

std::vector<Method> otherMethods(const std::string& peers) {
  const auto with_set_up = [](Surface& surface) { return makeDetectorPeerWithSetUp(kOurs, surface); };
  std::vector<Method> all = kMemoryReads;
  all.push_back({kOurs + " with set-up", with_set_up, true});
  for (const std::string& name : sweep_guard_core::detectorNames()) {
    if (name != kOurs) all.push_back(detector(name));
  }
  if (peers == "none") return all;
  for (const PeerKind& kind : peerKinds()) {
    if (peers == "scalar" && !kind.package.empty()) continue;
    if (kind.make) {
      all.push_back({kind.name, kind.make});
    } else {
      std::printf("skipped: %s, built without %s\n", kind.name.c_str(), kind.package.c_str());
    }
  }
  if (peers == "all") all.push_back({"OSMesa", makePlainSelectPeer});
  return all;
}

// Methods that also run on shuffled meshes and on sweeps with no hit or one.
bool runsOnEveryWorkload(const Method& method) {
  static const std::vector<std::string> kNames = {"memory read", "select", "scalar", "scalar box first",
                                                  "FCL AABB",    "Bullet", "Embree"};
  return std::find(kNames.begin(), kNames.end(), method.name) != kNames.end();
}

class Comparison {
 public:
  explicit Comparison(const Options& options)
      : options_(options), hull_(rings(options.triangles)), results_(options.csv) {}

  /// @returns whether our detectors made no error
  bool run() {
    const std::vector<Method> all = otherMethods(options_.peers);
    std::vector<Method> some;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some), runsOnEveryWorkload);
    compare(ordinary(hull_, Queries::kNone, deformations()), "update", kMemoryReads);
    const Workload sweep = ordinary(hull_, Queries::kSweep, deformations());
    const Workload sweeps = ordinary(hull_, Queries::kTwentySweeps, deformations());
    compare(sweep, sweep.name, all);
    compare(sweeps, sweeps.name, all);
    for (const Workload* workload : {&sweep, &sweeps}) compare(shuffled(*workload), "shuffled", some);
    if (options_.triangles > 200000) return right_;
    for (const size_t hits : {size_t{0}, size_t{1}}) {
      const Workload workload = grazing(hull_, hits, std::min<size_t>(8, deformations()));
      compare(workload, workload.name, some);
    }
    return right_;
  }

 private:
  static size_t rings(size_t triangles) {
    const double rings = std::round(std::sqrt(static_cast<double>(triangles) / 4.0));
    if (rings < 2.0 || rings > 5000.0) throw InvalidInput("--triangles: give a number from 16 to 100000000");
    return static_cast<size_t>(rings);
  }

  size_t deformations() const {
    if (options_.deformations > 0) return options_.deformations;
    return std::clamp<size_t>(50000000 / (6 * options_.triangles), 8, 32);
  }

  void compare(const Workload& workload, const std::string& work, const std::vector<Method>& methods) {
    std::printf("\n%s, %zu triangles, %zu queries, %.1f hits per frame (load %.1f)\n", work.c_str(),
                workload.surface.triangles.size(), workload.queries, workload.hits(), load());
    std::printf("%-26s %12s %12s %12s %9s %9s %7s %7s %7s\n", "method", "median us", "p10", "p90", "ratio", "p10",
                "misses", "extras", "frames");
    std::vector<double> ours_us;
    size_t misses = 0;
    size_t extras = 0;
    for (const Method& method : methods) {
      Entrant ours(workload, detector(kOurs).make);
      Entrant peer(workload, method.make);
      const Race result = race(workload, ours, peer, options_.limits);
      ours_us.insert(ours_us.end(), result.ours_us.begin(), result.ours_us.end());
      misses += ours.misses();
      extras += ours.extras();
      Row row = rowOf(work, workload, method.name, result.peer_us);
      row.ratio_median = quantile(result.ratio, 0.5);
      row.ratio_p10 = quantile(result.ratio, 0.1);
      if (peer.answers() && workload.queries > 0) {
        row.misses = peer.misses();
        row.extras = peer.extras();
      }
      if (method.is_ours) judge(row);
      write(row, result.ratio.size());
      if (!peer.answers()) printBandwidth(workload, row.median_us);
    }
    Row row = rowOf(work, workload, kOurs, ours_us);
    row.ratio_median = row.ratio_p10 = 1.0;
    if (workload.queries > 0) {
      row.misses = misses;
      row.extras = extras;
    }
    judge(row);
    write(row, ours_us.size());
  }

  static Row rowOf(const std::string& work, const Workload& workload, const std::string& method,
                   const std::vector<double>& times) {
    return makeRow(work, method, workload.surface.triangles.size(), workload.queries, times);
  }

  static void printBandwidth(const Workload& workload, double us) {
    const auto bytes = static_cast<double>(sizeof(float) * workload.surface.positions_M.size());
    std::printf("    %.1f GB/s, from two buffers of %.0f KB in turn, just written\n", 1e-3 * bytes / us, 1e-3 * bytes);
  }

  void judge(const Row& row) {
    if (row.misses.value_or(0) == 0 && row.extras.value_or(0) == 0) return;
    right_ = false;
    std::printf("WRONG: %s\n", row.method.c_str());
  }

  void write(const Row& row, size_t frames) {
    const auto count = [](const std::optional<size_t>& value) { return value ? std::to_string(*value) : "-"; };
    std::printf("%-26s %12.2f %12.2f %12.2f %9.3g %9.3g %7s %7s %7zu\n", row.method.c_str(), row.median_us, row.p10_us,
                row.p90_us, *row.ratio_median, *row.ratio_p10, count(row.misses).c_str(), count(row.extras).c_str(),
                frames);
    std::fflush(stdout);
    results_.write(row);
  }

  const Options& options_;
  Hull hull_;
  ResultFile results_;
  bool right_ = true;
};

int run(int argc, char** argv) {
  Options options;
  const po::options_description known = description(options);
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, known), values);
  po::notify(values);
  if (options.help) {
    std::cout << "usage: compare [OPTION...]\n" << known;
    return 0;
  }
  std::printf("%sours: %s\n", machineText().c_str(), kOurs.c_str());
  return Comparison(options).run() ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("compare", [&] { return sweep_guard_benchmark::run(argc, argv); });
}
