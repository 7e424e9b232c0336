// Compares the detectors with what else could do their work, on one size of a deforming hull.
//   compare --help
// Exit status 1: a detector of ours missed a triangle, or named one beyond its stated inflation.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>

#include "machine.h"
#include "peers/detector_peer.h"
#include "peers/peers.h"
#include "race.h"
#include "row.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_benchmark {
namespace {

namespace po = boost::program_options;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::Sample;

struct Options {
  size_t triangles = 1600;
  std::string csv;
  std::string peers = "all";
  size_t deformations = 0;
  Limits limits;
  bool help = false;
};

po::options_description described(Options& options) {
  po::options_description described("Options");
  described.add_options()("help,h", po::bool_switch(&options.help), "say this")(
      "triangles", po::value(&options.triangles)->default_value(options.triangles), "of the hull, about")(
      "csv", po::value(&options.csv)->value_name("FILE"), "results are added to this file")(
      "peers", po::value(&options.peers)->default_value(options.peers), "all, scalar or none")(
      "deformations", po::value(&options.deformations)->default_value(0),
      "different ones; 0: as many as fit into 50 MB")(
      "frames", po::value(&options.limits.frames)->default_value(options.limits.frames), "of each pair")(
      "seconds", po::value(&options.limits.seconds)->default_value(options.limits.seconds),
      "of each pair: no more frames then, but for the first three");
  return described;
}

struct Contender {
  std::string name;
  Entrant::Factory make;
  bool ours = false;
};

Contender detector(const std::string& name) {
  return {name, [name](Surface& surface) { return makeDetectorPeer(name, surface); }, true};
}

// Every position is read once: the limit, of a plain loop and of one that fetches ahead.
const std::vector<Contender> kMemoryReads = {{"memory read", makeMemoryRead},
                                             {"memory read fetched ahead", makeMemoryReadAhead}};

std::vector<Contender> others(const std::string& peers) {
  const auto whole = [](Surface& surface) { return makeWholeDetectorPeer(kOurs, surface); };
  std::vector<Contender> all = kMemoryReads;
  all.push_back({kOurs + " with set-up", whole, true});
  for (const std::string& name : sweep_guard_core::detectorNames()) {
    if (name != kOurs) all.push_back(detector(name));
  }
  if (peers == "none") return all;
  for (const PeerKind& kind : peerKinds()) {
    if (peers == "scalar" && !kind.package.empty()) continue;
    if (kind.make) {
      all.push_back({kind.name, kind.make});
    } else {
      std::printf("skipped: %s, which was built without %s\n", kind.name.c_str(), kind.package.c_str());
    }
  }
  if (peers == "all") all.push_back({"OSMesa", makePlainSelectPeer});
  return all;
}

// The ones that matter where the order or the number of hits is what is looked at.
bool chief(const Contender& contender) {
  static const std::vector<std::string> kNames = {"memory read", "select", "scalar", "scalar box first",
                                                  "FCL AABB",    "Bullet", "Embree"};
  return std::find(kNames.begin(), kNames.end(), contender.name) != kNames.end();
}

class Comparison {
 public:
  explicit Comparison(const Options& options) : options_(options), hull_(rings(options.triangles)) {
    if (options.csv.empty()) return;
    csv_.open(options.csv, std::ios::app);
    if (!csv_) throw InvalidInput(options.csv + ": cannot be written");
    if (csv_.tellp() == 0) csv_ << csvHeader();
  }

  /// @return whether all answers of ours are right
  bool run() {
    const std::vector<Contender> contenders = others(options_.peers);
    std::vector<Contender> chiefs;
    std::copy_if(contenders.begin(), contenders.end(), std::back_inserter(chiefs), chief);
    compare(ordinary(hull_, Question::kNothing, deformations()), "update", kMemoryReads);
    const Workload sweep = ordinary(hull_, Question::kSweep, deformations());
    const Workload sweeps = ordinary(hull_, Question::kTwentySweeps, deformations());
    compare(sweep, sweep.name, contenders);
    compare(sweeps, sweeps.name, contenders);
    for (const Workload* workload : {&sweep, &sweeps}) compare(shuffled(*workload), "shuffled", chiefs);
    if (options_.triangles > 200000) return right_;
    for (const size_t hits : {size_t{0}, size_t{1}}) {
      const Workload workload = grazing(hull_, hits, std::min<size_t>(8, deformations()));
      compare(workload, workload.name, chiefs);
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

  void compare(const Workload& workload, const std::string& work, const std::vector<Contender>& contenders) {
    std::printf("\n%s, %zu triangles, %zu queries, %.1f hits per frame (load %.1f)\n", work.c_str(),
                workload.surface.triangles.size(), workload.queries, workload.hits(), load());
    std::printf("%-26s %12s %12s %12s %9s %9s %7s %7s %7s\n", "method", "median us", "p10", "p90", "ratio", "p10",
                "misses", "extras", "frames");
    Sample ours_us;
    size_t misses = 0;
    size_t extras = 0;
    for (const Contender& contender : contenders) {
      Entrant ours(workload, detector(kOurs).make);
      Entrant peer(workload, contender.make);
      const Race result = race(workload, ours, peer, options_.limits);
      for (const double time : result.ours_us.values()) ours_us.add(time);
      misses += ours.misses();
      extras += ours.extras();
      Row row = rowOf(work, workload, contender.name, result.peer_us);
      row.ratio_median = result.ratio.quantile(0.5);
      row.ratio_p10 = result.ratio.quantile(0.1);
      if (peer.answers() && workload.queries > 0) {
        row.misses = peer.misses();
        row.extras = peer.extras();
      }
      if (contender.ours) judge(row);
      write(row, result.ratio.count());
      if (!peer.answers()) printBandwidth(workload, row.median_us);
    }
    Row row = rowOf(work, workload, kOurs, ours_us);
    row.ratio_median = row.ratio_p10 = 1.0;
    if (workload.queries > 0) {
      row.misses = misses;
      row.extras = extras;
    }
    judge(row);
    write(row, ours_us.count());
  }

  static Row rowOf(const std::string& work, const Workload& workload, const std::string& method, const Sample& us) {
    Row row;
    row.work = work;
    row.method = method;
    row.triangles = workload.surface.triangles.size();
    row.queries = workload.queries;
    row.median_us = us.quantile(0.5);
    row.p10_us = us.quantile(0.1);
    row.p90_us = us.quantile(0.9);
    return row;
  }

  static void printBandwidth(const Workload& workload, double us) {
    const auto bytes = static_cast<double>(sizeof(float) * workload.surface.positions_M.size());
    std::printf("    %.1f GB/s of two buffers in turn, of %.0f KB, just written\n", 1e-3 * bytes / us, 1e-3 * bytes);
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
    if (csv_.is_open()) csv_ << csvLine(row) << std::flush;
  }

  const Options& options_;
  Hull hull_;
  std::ofstream csv_;
  bool right_ = true;
};

int run(int argc, char** argv) {
  Options options;
  const po::options_description known = described(options);
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
  try {
    return sweep_guard_benchmark::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "compare: " << error.what() << '\n';
    return 2;
  }
}
