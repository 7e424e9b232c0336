// Measures the processor time that ProximityFinder takes per pose: a drill near the surface of a closed mesh and inside of it, and an
// arm of 7 links that swings beside it, a new deformation with every tenth pose.
//   proximity [--csv FILE]
#include <cstdio>
#include <ctime>

#include "common/rotation_between.h"
#include "common/run_program.h"
#include "drill.h"
#include "machine.h"
#include "row.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/motion/proximity_finder.h"
#include "swinging_arm.h"

namespace sweep_guard_benchmark {
namespace {

using namespace sweep_guard_core;
using namespace std::chrono_literals;

constexpr int kPoses = 2000;
constexpr int kPosesPerUpdate = 10;
constexpr double kReach = 0.1;   // [m]
constexpr double kRadius = 0.1;  // about that of the mesh [m]
const std::string kFrame = "world";

std::shared_ptr<const Workpiece> hullOf(int rings, double phase, Duration at) {
  return std::make_shared<const Workpiece>(
      Workpiece{"hull", 1, Time(100s) + at, SteadyTime(at), kFrame, wavyHull(rings, 2 * rings, phase)});
}

Workpieces deformations(int rings) {
  Workpieces all = {hullOf(rings, 0.0, 0ms)};
  for (int i = 1; i < 8; ++i) {
    auto next = std::make_shared<Workpiece>(*all.front());
    std::vector<float> positions = streamedPositions(wavyHull(rings, 2 * rings, 0.02 * i));
    next->mesh_M.deform(positions);
    next->stamp += i * 10ms;
    all.push_back(next);
  }
  return all;
}

// The tip at some height above a random place of the surface, the shaft outwards.
PoseWithFrames poseAbove(double height, Random& random) {
  const Eigen::Vector3d out = random.direction();
  PoseWithFrames pose{Time(100s), {}, Eigen::Isometry3d::Identity(), {{kFrame, Eigen::Isometry3d::Identity()}}};
  pose.X_WT.linear() = random.turn(0.3) * rotationBetween(-Eigen::Vector3d::UnitZ(), out).toRotationMatrix();
  pose.X_WT.translation() = (kRadius + height) * out;
  pose.bodies = {{pose.X_WT}};
  return pose;
}

double processorMicroseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

struct Place {
  const char* name;
  double lowest;   // [m]
  double highest;  // [m]
};

Row measure(int rings, const Place& place) {
  const Tool tool(drill());
  const Workpieces updates = deformations(rings);
  ProximityFinder finder;
  Proximity found;
  Random random(/*seed=*/1);
  std::vector<double> times;
  size_t planes = 0;
  for (int i = 0; i < kPoses; ++i) {
    PoseWithFrames pose = poseAbove(random.uniform(place.lowest, place.highest), random);
    pose.stamp += i * 1ms;
    const Workpieces workpieces = {updates[static_cast<size_t>(i / kPosesPerUpdate) % updates.size()]};
    const double begin = processorMicroseconds();
    finder.find({{&tool}, pose, workpieces, kReach}, found);
    times.push_back(processorMicroseconds() - begin);
    planes += found.planes.size();
  }
  std::printf("  %.1f planes\n", static_cast<double>(planes) / kPoses);
  return makeRow("proximity", place.name, updates[0]->mesh_M.triangles().size(), 1, times);
}

PoseWithFrames poseOf(const Robot& robot, double t, const Eigen::Isometry3d& X_WM) {
  std::vector<Eigen::Isometry3d> X_WB;
  bodyPoses(robot.tree, robot.bodies, stateAt(t), X_WB);
  PoseWithFrames pose{Time(100s) + fromSeconds(t), {}, Eigen::Isometry3d::Identity(), {{kFrame, X_WM}}};
  pose.bodies.clear();
  for (const Eigen::Isometry3d& X : X_WB) pose.bodies.push_back({X});
  return pose;
}

Row measureArm(int rings, const std::string& name, const Eigen::Isometry3d& X_WM) {
  const Robot robot = arm();
  const Workpieces updates = deformations(rings);
  BodyTools bodies;
  for (const Tool& tool : robot.tools) bodies.push_back(&tool);
  ProximityFinder finder;
  Proximity found;
  std::vector<double> times;
  size_t planes = 0;
  for (int i = 0; i < kPoses; ++i) {
    const PoseWithFrames pose = poseOf(robot, 0.005 * i, X_WM);
    const Workpieces workpieces = {updates[static_cast<size_t>(i / kPosesPerUpdate) % updates.size()]};
    const double begin = processorMicroseconds();
    finder.find({bodies, pose, workpieces, kReach}, found);
    times.push_back(processorMicroseconds() - begin);
    planes += found.planes.size();
  }
  std::printf("  %.1f planes\n", static_cast<double>(planes) / kPoses);
  return makeRow("proximity", name, updates[0]->mesh_M.triangles().size(), kLinks, times);
}

void report(const Row& row, ResultFile& results) {
  std::printf("%zu triangles, %s: %.1f us (%.1f to %.1f)\n", row.triangles, row.method.c_str(), row.median_us,
              row.p10_us, row.p90_us);
  results.write(row);
}

int run(const std::vector<std::string>& arguments) {
  const bool has_csv = arguments.size() == 2 && arguments[0] == "--csv";
  if (!arguments.empty() && !has_csv) throw InvalidInput("usage: proximity [--csv FILE]");
  ResultFile results(has_csv ? arguments[1] : "");
  std::printf("%sload %.2f\n", machineText().c_str(), load());
  for (const int rings : {20, 71, 158}) {
    for (const Place& place :
         {Place{"near the surface", 0.012, 0.03}, Place{"in contact", -0.005, 0.0}, Place{"inside", -0.08, -0.03}}) {
      report(measure(rings, place), results);
    }
    report(measureArm(rings, "arm beside", placedAt(0.17, 0.0, 0.3)), results);
    report(measureArm(rings, "arm in reach", placedAt(0.25, 0.0, 0.8)), results);
  }
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("proximity", [&] { return sweep_guard_benchmark::run({argv + 1, argv + argc}); });
}
