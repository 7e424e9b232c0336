// Measures the processor time of a step of an elastic workpiece while a cylinder presses 10 mm into it and leaves again.
//   elastic [MESH]   an STL, OBJ or DAE file, scaled to 0.25 m; without it a wavy hull of 4 400 triangles
#include <algorithm>
#include <cstdio>

#include "common/run_program.h"
#include "machine.h"
#include "microseconds.h"
#include "row.h"
#include "simulation/drilling.h"
#include "simulation/elastic/elastic_workpiece.h"
#include "simulation/workpiece.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

using namespace sweep_guard_simulation;
using sweep_guard_core::processorMicroseconds;
using sweep_guard_core::TriangleMesh;

constexpr double kRate = 60.0;  // [Hz]
constexpr int kSteps = 600;
constexpr double kDepth = 0.01;     // [m]
constexpr double kHeight = 0.01;    // above the surface, at the ends [m]
constexpr double kStiffness = 3e6;  // [N/m^3]

TriangleMesh meshOf(const Workpiece& workpiece) {
  std::vector<Eigen::Vector3d> vertices;
  const std::vector<float> positions = workpiece.positions(0.0);
  for (size_t i = 0; i < positions.size(); i += 3) {
    vertices.emplace_back(positions[i], positions[i + 1], positions[i + 2]);
  }
  return {vertices, workpiece.triangles()};
}

double depthAt(int step) {
  const double share = std::min(1.0, 2.0 - std::abs(4.0 * step / kSteps - 2.0));  // down, at rest, up
  return share * (kDepth + kHeight) - kHeight;
}

int run(const std::vector<std::string>& arguments) {
  if (arguments.size() > 1) throw sweep_guard_core::InvalidInput("usage: elastic [MESH]");
  std::printf("%sload %.2f\n", machineText().c_str(), load());
  Workpiece::Options rest;
  rest.size = 0.25;
  rest.amplitude = 0.0;
  const Workpiece mesh = arguments.empty() ? Workpiece::hull(4400, rest) : Workpiece::fromFile(arguments[0], rest);
  ElasticWorkpiece::Options options;
  options.motion.step = 1.0 / kRate;
  options.motion.damping = 10.0;
  const double begin = processorMicroseconds();
  ElasticWorkpiece workpiece(mesh.positions(0.0), mesh.triangles(), options);
  const double start = processorMicroseconds() - begin;
  sweep_guard_core::ForceLaw law;
  law.stiffness = kStiffness;
  workpiece.setTool(sweep_guard_core::Tool::cylinder(/*radius=*/0.01, /*length=*/0.15), law);
  const Eigen::Vector3d top = highestPoint(meshOf(mesh));
  std::vector<double> times;
  double dent = 0.0;
  double force = 0.0;
  for (int step = 0; step <= kSteps; ++step) {
    const Eigen::Isometry3d X_MT =
        Eigen::Translation3d(top - depthAt(step) * Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
    const double before = processorMicroseconds();
    workpiece.advance(X_MT);
    times.push_back(processorMicroseconds() - before);
    dent = std::max(dent, workpiece.dent());
    force = std::max(force, workpiece.force_M().norm());
  }
  const BarStructure& structure = workpiece.model().structure();
  const Row row = makeRow("elastic", "step", mesh.triangles().size(), 1, times);
  std::printf("%zu triangles, %zu nodes, %zu bars, made in %.0f ms; dent %.1f mm, %.2f N\n", row.triangles,
              structure.fixed.size(), structure.bars.size(), 1e-3 * start, 1e3 * dent, force);
  std::printf("a step: %.2f ms (%.2f to %.2f), at most %.2f ms\n", 1e-3 * row.median_us, 1e-3 * row.p10_us,
              1e-3 * row.p90_us, 1e-3 * *std::max_element(times.begin(), times.end()));
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("elastic", [&] { return sweep_guard_benchmark::run({argv + 1, argv + argc}); });
}
