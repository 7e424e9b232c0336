// Measures what a sweep costs besides looking at the mesh: its volume, and the fine phase for a triangle that it meets.
//   set_up [--csv FILE]
#include <cstdio>
#include <fstream>
#include <iostream>

#include "microseconds.h"
#include "row.h"
#include "sample.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "workload.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::microseconds;
using sweep_guard_core::Motion;
using sweep_guard_core::Sample;
using sweep_guard_core::VolumeKind;

constexpr size_t kRings = 158;
constexpr size_t kFrames = 32;
constexpr int kRepetitions = 100;

Row rowOf(const std::string& work, const std::string& method, size_t triangles, const Sample& us) {
  Row row;
  row.work = work;
  row.method = method;
  row.triangles = triangles;
  row.queries = 1;
  row.median_us = us.quantile(0.5);
  row.p10_us = us.quantile(0.1);
  row.p90_us = us.quantile(0.9);
  return row;
}

// All frames at a time: a single volume is too short to be timed.
Row setUp(const Workload& workload, VolumeKind kind) {
  const sweep_guard_core::ConvexShape tool = drill();
  Sample us;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const double time = microseconds([&] {
      for (const Frame& frame : workload.frames) sweptVolume(tool, frame.motions_M[0], kind);
    });
    us.add(time / static_cast<double>(workload.frames.size()));
  }
  return rowOf("set-up", nameOf(kind), 0, us);
}

Row finePhase(const Workload& workload) {
  const sweep_guard_core::ConvexShape tool = drill();
  Sample us;
  for (const Frame& frame : workload.frames) {
    if (frame.truth[0].empty()) continue;
    const auto at = [&](size_t i) -> Eigen::Vector3d {
      return Eigen::Map<const Eigen::Vector3f>(&frame.positions_M[3 * i]).cast<double>();
    };
    const std::vector<Motion> parts = split(frame.motions_M[0], 0.1745);
    const double time = microseconds([&] {
      for (const std::uint32_t id : frame.truth[0]) {
        const auto& [a, b, c] = workload.surface.triangles[id];
        const std::array<Eigen::Vector3d, 3> corners = {at(a), at(b), at(c)};
        timeOfImpact(tool, parts, {corners, corners}, 0.0);
      }
    });
    us.add(time / static_cast<double>(frame.truth[0].size()));
  }
  return rowOf("fine phase", "per triangle met", workload.surface.triangles.size(), us);
}

int run(const std::vector<std::string>& arguments) {
  const bool written = arguments.size() == 2 && arguments[0] == "--csv";
  if (!arguments.empty() && !written) throw InvalidInput("usage: set_up [--csv FILE]");
  const Workload workload = ordinary(Hull(kRings), Question::kSweep, kFrames);
  const std::vector<Row> rows = {setUp(workload, VolumeKind::kObb), setUp(workload, VolumeKind::kObbPlanes),
                                 setUp(workload, VolumeKind::kHull), finePhase(workload)};
  for (const Row& row : rows) {
    std::printf("%s, %s: %.3f us (%.3f to %.3f)\n", row.work.c_str(), row.method.c_str(), row.median_us, row.p10_us,
                row.p90_us);
  }
  if (!written) return 0;
  std::ofstream csv(arguments[1], std::ios::app);
  if (csv.tellp() == 0) csv << csvHeader();
  for (const Row& row : rows) csv << csvLine(row);
  if (!csv.flush()) throw InvalidInput(arguments[1] + ": cannot be written");
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  try {
    return sweep_guard_benchmark::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "set_up: " << error.what() << '\n';
    return 2;
  }
}
