// Measures the processor time of the interpenetration of a cylinder with a closed mesh, where the cylinder touches
// about 200 triangles.
//   interaction [--csv FILE]
#include <cstdio>

#include "common/rotation_between.h"
#include "common/run_program.h"
#include "machine.h"
#include "microseconds.h"
#include "row.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/interaction/interpenetration.h"

namespace sweep_guard_benchmark {
namespace {

using namespace sweep_guard_core;

constexpr int kPoses = 500;
constexpr int kRounds = 20;
constexpr double kRadius = 0.1;  // about that of the mesh [m]

// The tip 20 to 30 mm behind a random place of the surface, the shaft outwards.
Eigen::Isometry3d poseInside(Random& random) {
  const Eigen::Vector3d out = random.direction();
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();
  X_MT.linear() = random.turn(0.3) * rotationBetween(-Eigen::Vector3d::UnitZ(), out).toRotationMatrix();
  X_MT.translation() = (kRadius - random.uniform(0.02, 0.03)) * out;
  return X_MT;
}

size_t touched(const TriangleMesh& mesh_M, const Tool& tool, const Eigen::Isometry3d& X_MT) {
  const auto detector = makeDetector("halfspace");
  return checkPath(*detector, {tool, {X_MT}, mesh_M}).all.in_contact.size();
}

int run(const std::vector<std::string>& arguments) {
  const bool has_csv = arguments.size() == 2 && arguments[0] == "--csv";
  if (!arguments.empty() && !has_csv) throw InvalidInput("usage: interaction [--csv FILE]");
  ResultFile results(has_csv ? arguments[1] : "");
  std::printf("%sload %.2f\n", machineText().c_str(), load());
  const TriangleMesh mesh_M = wavyHull(/*rings=*/125, /*sectors=*/250, 0.0);
  const ConvexShape shape_T = ConvexShape::cylinder(/*radius=*/0.01, /*length=*/0.1);
  const Tool tool(shape_T);
  Random random(/*seed=*/1);
  std::vector<Eigen::Isometry3d> poses;
  std::vector<double> times;
  size_t triangles = 0;
  for (int i = 0; i < kPoses; ++i) {
    poses.push_back(poseInside(random));
    triangles += touched(mesh_M, tool, poses.back());
  }
  InterpenetrationFinder finder(shape_T);
  double volume = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    for (const Eigen::Isometry3d& X_MT : poses) {
      const double begin = processorMicroseconds();
      volume += finder.find(mesh_M, X_MT).volume;
      times.push_back(processorMicroseconds() - begin);
    }
  }
  const Row row = makeRow("interaction", "cylinder", mesh_M.triangles().size(), 1, times);
  std::printf("%zu triangles, of which %.0f are touched, mean volume %.3g m^3: %.1f us (%.1f to %.1f)\n", row.triangles,
              static_cast<double>(triangles) / kPoses, volume / static_cast<double>(times.size()), row.median_us,
              row.p10_us, row.p90_us);
  results.write(row);
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("interaction", [&] {
    return sweep_guard_benchmark::run({argv + 1, argv + argc});
  });
}
