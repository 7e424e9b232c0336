// Measures what a sweep costs apart from the detector: its volume, and the narrow phase per triangle met.
//   set_up [--csv FILE]
#include <cstdio>

#include "common/run_program.h"
#include "microseconds.h"
#include "row.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "workload.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::microseconds;
using sweep_guard_core::Motion;
using sweep_guard_core::VolumeKind;

constexpr size_t kRings = 158;
constexpr size_t kFrames = 32;
constexpr int kRepetitions = 100;

// All frames at once: a single volume takes too little time to measure.
Row setUp(const Workload& workload, VolumeKind kind) {
  const sweep_guard_core::ConvexShape tool = drill();
  std::vector<double> times;
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    const double time = microseconds([&] {
      for (const Frame& frame : workload.frames) sweptVolume(tool, frame.motions_M[0], kind);
    });
    times.push_back(time / static_cast<double>(workload.frames.size()));
  }
  return makeRow("set-up", nameOf(kind), 0, 1, times);
}

Row narrowPhase(const Workload& workload) {
  const sweep_guard_core::ConvexShape tool = drill();
  std::vector<double> times;
  for (const Frame& frame : workload.frames) {
    if (frame.truth[0].empty()) continue;
    const auto at = [&](size_t i) -> Eigen::Vector3d {
      return Eigen::Map<const Eigen::Vector3f>(&frame.positions_M[3 * i]).cast<double>();
    };
    const std::vector<Motion> sub_motions = split(frame.motions_M[0], 0.1745);
    const double time = microseconds([&] {
      for (const std::uint32_t id : frame.truth[0]) {
        const auto& [a, b, c] = workload.surface.triangles[id];
        const std::array<Eigen::Vector3d, 3> corners = {at(a), at(b), at(c)};
        timeOfImpact(tool, sub_motions, {corners, corners}, 0.0);
      }
    });
    times.push_back(time / static_cast<double>(frame.truth[0].size()));
  }
  return makeRow("fine phase", "per triangle met", workload.surface.triangles.size(), 1, times);
}

int run(const std::vector<std::string>& arguments) {
  const bool has_csv = arguments.size() == 2 && arguments[0] == "--csv";
  if (!arguments.empty() && !has_csv) throw InvalidInput("usage: set_up [--csv FILE]");
  ResultFile results(has_csv ? arguments[1] : "");
  const Workload workload = ordinary(Hull(kRings), Queries::kSweep, kFrames);
  const std::vector<Row> rows = {setUp(workload, VolumeKind::kObb), setUp(workload, VolumeKind::kObbPlanes),
                                 setUp(workload, VolumeKind::kHull), narrowPhase(workload)};
  for (const Row& row : rows) {
    std::printf("%s, %s: %.3f us (%.3f to %.3f)\n", row.work.c_str(), row.method.c_str(), row.median_us, row.p10_us,
                row.p90_us);
    results.write(row);
  }
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("set_up", [&] { return sweep_guard_benchmark::run({argv + 1, argv + argc}); });
}
