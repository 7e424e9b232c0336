// Measures what guarding an arm costs: 7 links of 20 convex pieces each, joints at up to 1 rad/s, states at 200 Hz, a mesh that
// deforms at 60 Hz, one measured sweep and a prediction of 21 steps by the joints for each state. One thread; the time that a
// processor spends on it, which also counts for the guard's cycle.
// Beside it in the same run: FCL and Bullet, if they are installed, test the same pieces at the same poses, static and
// without a prediction.
//   arm [--triangles N] [--detector NAME] [--rate HZ] [--peers none] [--csv FILE]
// The guard has 1 / HZ for each state.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/run_program.h"
#include "machine.h"
#include "microseconds.h"
#include "peers/peers.h"
#include "row.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/guard/guard.h"
#include "swinging_arm.h"

namespace sweep_guard_benchmark {
namespace {

using namespace sweep_guard_core;

constexpr int kStates = 600;
constexpr int kWarmUp = 100;  // states
constexpr size_t kDeformations = 12;
constexpr double kPeriod = 1.0 / 200.0;  // [s]
constexpr double kFrame = 1.0 / 60.0;    // of the mesh [s]
const std::string kMesh = "hull";

TriangleMesh hullAt(double phase, int triangles) {
  const int rings = std::max(4, static_cast<int>(std::sqrt(triangles / 4.0)));
  return wavyHull(rings, triangles / (2 * (rings - 1)), phase);
}

// Of 0.25 m, beside the end of the arm.
std::vector<std::vector<float>> positionsOfDeformations(int triangles) {
  std::vector<std::vector<float>> all;
  for (size_t i = 0; i < kDeformations; ++i) {
    all.push_back(streamedPositions(hullAt(2.0 * M_PI * static_cast<double>(i) / kDeformations, triangles)));
    for (float& coordinate : all.back()) coordinate *= 1.25F;
  }
  return all;
}

std::vector<Workpieces> deformations(int triangles) {
  const TriangleMesh first = hullAt(0.0, triangles);
  std::vector<Workpieces> all;
  for (std::vector<float>& positions : positionsOfDeformations(triangles)) {
    all.push_back(
        {std::make_shared<const Workpiece>(Workpiece{kMesh, 0, {}, {}, kMesh, deformed(first, std::move(positions))})});
  }
  return all;
}

Workpieces stamped(const Workpieces& deformation, Time stamp, const Workpieces& before) {
  auto workpiece = std::make_shared<Workpiece>(*deformation.front());
  workpiece->stamp = stamp;
  if (!before.empty()) countUpdate(*before.front(), *workpiece);
  return {workpiece};
}

PoseWithFrames poseAt(const Robot& robot, double t, const Eigen::Isometry3d& X_WM) {
  const RobotState state = stateAt(t);
  const RobotMotion motion(robot.tree, robot.bodies, stateAt(t - kPeriod), state);
  std::vector<Eigen::Isometry3d> X_WB;
  bodyPoses(robot.tree, robot.bodies, state, X_WB);
  PoseWithFrames pose{Time(fromSeconds(10.0 + t)), {}, Eigen::Isometry3d::Identity(), {{kMesh, X_WM}}};
  pose.bodies.clear();
  for (size_t i = 0; i < X_WB.size(); ++i) pose.bodies.push_back({X_WB[i], motion.deviationBound(i, 1)});
  pose.state = state;
  return pose;
}

// A library that tests every piece at its pose, after it has taken over the vertices if there are new ones.
class StaticTest {
 public:
  StaticTest(const PeerKind& kind, int triangles) : positions_(positionsOfDeformations(triangles)) {
    surface_.positions_M = positions_.front();
    const TriangleMesh hull = hullAt(0.0, triangles);
    surface_.triangles.assign(hull.triangles().begin(), hull.triangles().end());
    peer_ = kind.make(surface_);
  }

  void deform(size_t number) {
    std::copy(positions_[number].begin(), positions_[number].end(), surface_.positions_M.begin());
    const double took = processorTime([&] { peer_->update(); });
    now_ += took;
  }

  void test(const Robot& robot, const PoseWithFrames& pose) {
    std::vector<Motion> motions_M;
    std::vector<SweptVolume> boxes_M;
    for (size_t body = 0; body < robot.tools.size(); ++body) {
      const Eigen::Isometry3d X_MB = pose.X_WM.at(kMesh).inverse() * pose.bodies[body].X_WB;
      for (const ConvexPiece& piece : robot.tools[body].pieces()) {
        motions_M.push_back({X_MB, X_MB});
        boxes_M.push_back(sweptVolume(piece.shape_T, motions_M.back(), VolumeKind::kObb));
      }
    }
    std::vector<Polytope> pieces_M;
    for (size_t i = 0; i < boxes_M.size(); ++i) pieces_M.push_back(polytope(boxes_M[i], motions_M[i]));
    peer_->prepare(pieces_M);
    std::vector<TriangleIds> met(pieces_M.size());
    now_ += processorTime([&] { peer_->queryAll(met); });
    times_.push_back(std::exchange(now_, 0.0));
  }

  const std::vector<double>& times() const { return times_; }

 private:
  std::vector<std::vector<float>> positions_;
  Surface surface_;
  std::unique_ptr<Peer> peer_;
  double now_ = 0.0;
  std::vector<double> times_;  // [us], of each state
};

struct Static {
  std::string name;
  std::unique_ptr<StaticTest> test;
};

std::vector<Static> staticTests(int triangles) {
  std::vector<Static> tests;
  for (const PeerKind& kind : peerKinds()) {
    const bool library = kind.name.rfind("FCL", 0) == 0 || kind.name == "Bullet contactPairTest";
    if (library && kind.make) tests.push_back({kind.name, std::make_unique<StaticTest>(kind, triangles)});
    if (library && !kind.make) std::printf("%s is missing: install %s\n", kind.name.c_str(), kind.package.c_str());
  }
  return tests;
}

struct Options {
  int triangles = 20000;
  std::string detector = "halfspace";
  double rate = 15.0;  // [Hz]
  bool peers = true;
};

struct Times {
  std::vector<double> sweeps;
  std::vector<double> both;
  size_t contacts = 0;
  size_t volumes = 0;
};

Times guard(const Options& options, const Eigen::Isometry3d& X_WM, std::vector<Static>& tests) {
  const auto robot = std::make_shared<const Robot>(arm());
  const std::vector<Workpieces> all = deformations(options.triangles);
  GuardOptions guard_options;
  guard_options.cycle = fromSeconds(1.0 / options.rate);
  guard_options.clock = [] { return SteadyTime(fromSeconds(1e-6 * processorMicroseconds())); };
  Guard guard(robot, makeDetector(options.detector), guard_options);
  SweepReport report;
  Prediction prediction;
  Workpieces now;
  int frame = -1;
  Times times;
  for (int i = 0; i < kStates; ++i) {
    const double t = kPeriod * i;
    const PoseWithFrames pose = poseAt(*robot, t, X_WM);
    if (static_cast<int>(t / kFrame) != frame) {
      frame = static_cast<int>(t / kFrame);
      now = stamped(all[static_cast<size_t>(frame) % kDeformations], pose.stamp, now);
      for (const Static& one : tests) one.test->deform(static_cast<size_t>(frame) % kDeformations);
    }
    const double swept = processorTime([&] { guard.sweep(pose, now, report); });
    const double predicted = processorTime([&] { guard.predict({}, now, prediction); });
    for (const Static& one : tests) one.test->test(*robot, pose);
    if (i < kWarmUp) continue;
    times.sweeps.push_back(swept);
    times.both.push_back(swept + predicted);
    times.contacts += report.contact() ? 1 : 0;
    for (const PredictedObject& object : prediction.objects) times.volumes += object.volumes_tested;
  }
  return times;
}

void report(const std::string& place, const Times& times, ResultFile& results, const Options& options) {
  const auto states = static_cast<double>(times.both.size());
  const double p99 = quantile(times.both, 0.99);
  std::printf(
      "%-8s %s, %d triangles: sweep %.0f us (p99 %.0f), sweep and prediction %.0f us (p99 %.0f); contact in %.0f %%, "
      "%.0f predicted volumes\n",
      place.c_str(), options.detector.c_str(), options.triangles, quantile(times.sweeps, 0.5),
      quantile(times.sweeps, 0.99), quantile(times.both, 0.5), p99,
      100.0 * static_cast<double>(times.contacts) / states, static_cast<double>(times.volumes) / states);
  results.write(makeRow("arm " + place, options.detector, static_cast<size_t>(options.triangles), kLinks, times.both));
}

void guardAt(const std::string& place, const Eigen::Isometry3d& X_WM, const Options& options, ResultFile& results) {
  std::vector<Static> tests;
  if (options.peers) tests = staticTests(options.triangles);
  const Times times = guard(options, X_WM, tests);
  report(place, times, results, options);
  for (const Static& one : tests) {
    const double median = quantile(one.test->times(), 0.5);
    std::printf(
        "  %s, static tests of the same poses: %.0f us (p99 %.0f); our sweep takes %.2f, with the prediction %.1f "
        "times as long\n",
        one.name.c_str(), median, quantile(one.test->times(), 0.99), quantile(times.sweeps, 0.5) / median,
        quantile(times.both, 0.5) / median);
    results.write(
        makeRow("arm static " + place, one.name, static_cast<size_t>(options.triangles), kLinks, one.test->times()));
  }
}

// What goes first finds a colder cache: each goes first in every other state.
template <typename With, typename Without>
double howMuchMore(int state, const With& with, const Without& without) {
  if (state % 2 == 1) {
    const double took = processorTime(without);
    return processorTime(with) - took;
  }
  const double took = processorTime(with);
  return took - processorTime(without);
}

// Of each two states after the warm-up.
std::vector<double> means(const std::vector<double>& all, double share) {
  std::vector<double> means;
  for (size_t i = kWarmUp; i + 1 < all.size(); i += 2) means.push_back(0.5 * (all[i] + all[i + 1]) / share);
  return means;
}

Workpieces restingMeshes(size_t count, int triangles) {
  const Workpiece mesh = *deformations(triangles).front().front();
  Workpieces meshes;
  for (size_t i = 0; i < count; ++i) {
    auto one = std::make_shared<Workpiece>(mesh);
    one->id += std::to_string(i);
    meshes.push_back(std::move(one));
  }
  return meshes;
}

// What each of some meshes far away costs more than the first few of them.
void outside(const Options& options, size_t meshes, size_t few) {
  const auto robot = std::make_shared<const Robot>(arm());
  const Workpieces all = restingMeshes(meshes, options.triangles);
  const Workpieces first(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(few));
  Guard of_all(robot, makeDetector(options.detector), {});
  Guard of_few(robot, makeDetector(options.detector), {});
  SweepReport report;
  Prediction prediction;
  Prediction of_first;
  std::vector<double> sweeps;
  std::vector<double> predictions;
  for (int i = 0; i < kStates; ++i) {
    const PoseWithFrames pose = poseAt(*robot, kPeriod * i, Eigen::Isometry3d(Eigen::Translation3d(50.0, 0.0, 0.0)));
    sweeps.push_back(howMuchMore(
        i, [&] { of_all.sweep(pose, all, report); }, [&] { of_few.sweep(pose, first, report); }));
    predictions.push_back(howMuchMore(
        i, [&] { of_all.predict({}, all, prediction); }, [&] { of_few.predict({}, first, of_first); }));
  }
  const auto bodies = static_cast<double>(kLinks * (meshes - few));
  const std::vector<double> swept = means(sweeps, bodies);
  const std::vector<double> predicted = means(predictions, bodies * static_cast<double>(prediction.sweeps_made));
  std::printf(
      "a body outside of each of %zu meshes, more than of %zu: %.2f us (p99 %.2f) for each measured sweep, %.3f us "
      "(p99 "
      "%.3f) for each predicted one\n",
      meshes, few, quantile(swept, 0.5), quantile(swept, 0.99), quantile(predicted, 0.5), quantile(predicted, 0.99));
}

int run(const std::vector<std::string>& arguments) {
  std::string csv;
  Options options;
  for (size_t i = 0; i + 1 < arguments.size(); i += 2) {
    if (arguments[i] == "--csv") csv = arguments[i + 1];
    if (arguments[i] == "--detector") options.detector = arguments[i + 1];
    if (arguments[i] == "--triangles") options.triangles = std::stoi(arguments[i + 1]);
    if (arguments[i] == "--peers") options.peers = arguments[i + 1] != "none";
    if (arguments[i] == "--rate") options.rate = std::stod(arguments[i + 1]);
  }
  if (arguments.size() % 2 != 0)
    throw InvalidInput("usage: arm [--triangles N] [--detector NAME] [--rate HZ] [--peers none] [--csv FILE]");
  ResultFile results(csv);
  std::printf("%sload %.2f\n", machineText().c_str(), load());
  const auto at = [](double x, double z) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, z)); };
  guardAt("beside", at(0.45, 0.6), options, results);
  guardAt("in reach", at(0.25, 0.8), options, results);
  guardAt("far", at(50.0, 0.0), options, results);
  outside(options, 1, 0);
  outside(options, 8, 1);
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("arm", [&] { return sweep_guard_benchmark::run({argv + 1, argv + argc}); });
}
