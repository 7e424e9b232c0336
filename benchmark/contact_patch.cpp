// Measures the processor time that a patch of some 1 700 triangles in contact takes: the narrow phase per triangle in contact, and the whole guard
// per pose, with poses at 1 kHz and a deformation at 60 Hz.
//   contact_patch [--csv FILE]
#include <cmath>
#include <cstdio>

#include "common/run_program.h"
#include "guard/sweep_checker.h"
#include "microseconds.h"
#include "row.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_benchmark {
namespace {

using namespace sweep_guard_core;
using namespace std::chrono_literals;

constexpr std::uint32_t kCells = 100;  // along each side of the sheet
constexpr double kCell = 0.001;        // [m]
constexpr int kFrames = 20;
constexpr int kRepetitions = 5;
constexpr int kSeconds = 2;
constexpr int kUpdates = 60;  // per second
constexpr int kPoses = 1000;  // per second
constexpr int kPredictionPeriod = 50;

TriangleMesh sheet(double phase) {
  return gridSurface(kCells, kCells * kCell, [phase](double x, double y) {
    return 0.0005 * std::sin(200.0 * x + phase) * std::sin(150.0 * y - 0.7 * phase);
  });
}

struct Presser {
  const char* name;
  ConvexShape shape_T;  // stands through the sheet z = 0, or lies in it
  double above;         // it is free there [m]
};

ConvexShape polytope() {
  Random random(/*seed=*/5);
  std::vector<Eigen::Vector3d> points;
  points.reserve(60);
  for (int i = 0; i < 60; ++i)
    points.emplace_back(Eigen::Vector3d(0.0168, 0.0168, 0.03).cwiseProduct(random.direction()));
  return ConvexShape::hull(points);
}

std::vector<Presser> pressers() {
  Eigen::Isometry3d X_TC = Eigen::Isometry3d::Identity();
  X_TC.translation().z() = 0.09;
  const ConvexShape capsule = ConvexShape::hull({{-0.033, 0, 0}, {0.033, 0, 0}}).padded(0.005);
  return {{"drill", ConvexShape::cylinder(0.0155, 0.1).placed(X_TC), 0.0107},
          {"capsule", capsule, 0.0056},
          {"hull", polytope(), 0.0306}};
}

Eigen::Isometry3d pose(double x, double y, double z, double tilt, double yaw) {
  Eigen::Isometry3d X_MT(Eigen::Translation3d(x, y, z));
  X_MT.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  X_MT.rotate(Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()));
  return X_MT;
}

// Names the triangles that it is given, in no time.
class Named : public Detector {
 public:
  TriangleSet triangles;

 private:
  void find(const Submesh& /*submesh*/, const SweptVolume& /*swept_M*/, Detection& detection) override {
    detection.triangles = triangles;
  }
};

struct Sweep {
  std::vector<Motion> sub_motions_M;
  MovingMesh mesh;
  SweepCache cache;
  TriangleSet named;
};

class PatchTimes {
 public:
  explicit PatchTimes(const Tool& tool) : tool_(tool) {}

  // Returns what the sweep leaves for the next one.
  SweepCache measure(Sweep sweep) {
    SweepCache after = sweepCache(check(*halfspace_, sweep));
    named_.triangles = result_->triangles;
    contacts_.push_back(static_cast<double>(after.contact_normals.size()));
    for (int i = 0; i < kRepetitions; ++i) {
      const double time = processorTime([&] { check(named_, sweep); });
      times_.push_back(time / contacts_.back());
    }
    return after;
  }

  const std::vector<double>& times() const { return times_; }
  double contacts() const { return quantile(contacts_, 0.5); }

 private:
  const SweepResult& check(Detector& detector, const Sweep& sweep) {
    result_ = &checker_.check(detector, {tool_, sweep.sub_motions_M, sweep.mesh, {}, sweep.cache});
    return *result_;
  }

  const Tool& tool_;
  SweepChecker checker_;
  std::unique_ptr<Detector> halfspace_ = makeDetector("halfspace");
  Named named_;
  const SweepResult* result_ = nullptr;
  std::vector<double> times_;
  std::vector<double> contacts_;
};

std::vector<Row> narrowPhase(const Presser& presser) {
  const Tool tool(presser.shape_T);
  const TriangleMesh before = sheet(0.0);
  const TriangleMesh after = deformed(before, streamedPositions(sheet(0.1)));
  const Displacements displacements(before, after);
  PatchTimes at_start(tool);
  PatchTimes on_the_way(tool);
  PatchTimes again(tool);
  PatchTimes deforming(tool);
  Random random(/*seed=*/1);
  for (int i = 0; i < kFrames; ++i) {
    const double x = random.uniform(-0.01, 0.01);
    const double y = random.uniform(-0.01, 0.01);
    const double yaw = random.uniform(0.0, 6.0);
    const double tilt = random.uniform(-0.02, 0.02);
    const auto at = [&](double z, double turn) { return pose(x, y, z, tilt + turn, yaw); };
    const auto motion = [&](double from, double to) {
      return split(Motion{at(from, 0.0), at(to, 0.001)}, SweepOptions{}.max_rotation);
    };
    const std::vector<Motion> pressed = motion(-0.001, -0.00105);
    const SweepCache touched = at_start.measure({pressed, before, {}, {}});
    again.measure({pressed, before, touched, {}});
    deforming.measure({pressed, {after, before, displacements, 0.0}, touched, {}});
    on_the_way.measure({motion(presser.above, presser.above - 0.003), before, {}, {}});
  }
  const auto row = [&](const char* what, const PatchTimes& times) {
    return makeRow("contact patch", std::string(presser.name) + ", " + what, static_cast<size_t>(times.contacts()), 1,
                   times.times());
  };
  return {row("met at the start", at_start), row("met on the way", on_the_way), row("met again", again),
          row("met again, deforming", deforming)};
}

const std::string kFrame = "world";

std::vector<std::shared_ptr<const Workpiece>> updates() {
  std::vector<std::shared_ptr<const Workpiece>> all = {
      std::make_shared<Workpiece>(Workpiece{"sheet", 1, Time(100s), {}, kFrame, sheet(0.0)})};
  for (int i = 1; i <= kUpdates * kSeconds; ++i) {
    auto next = std::make_shared<Workpiece>(*all.back());
    std::vector<float> positions = streamedPositions(sheet(2.0 * std::sin(6.2832 * i / kUpdates)));
    next->mesh_M.deform(positions);
    next->stamp = Time(100s) + fromSeconds(static_cast<double>(i) / kUpdates);
    countUpdate(*all.back(), *next);
    all.push_back(next);
  }
  return all;
}

// The tool stays in the sheet and moves like a hand. Each pose is swept; some are followed by a prediction.
std::vector<Row> wholeGuard(const Presser& presser) {
  Guard guard(Tool(presser.shape_T), makeDetector("halfspace"), {});
  const auto sheets = updates();
  Workpieces workpieces = {sheets[0]};
  SweepReport report;
  Prediction prediction;
  std::vector<double> contacts;
  std::vector<double> sweeps(kSeconds);
  std::vector<double> predictions;
  for (int i = 0; i < kPoses * kSeconds; ++i) {
    const double t = static_cast<double>(i) / kPoses;
    const auto second = static_cast<size_t>(i / kPoses);
    const PoseWithFrames at{
        Time(100s) + fromSeconds(t),
        SteadyTime(fromSeconds(t)),
        pose(0.01 * std::cos(3.0 * t), 0.01 * std::sin(3.0 * t), -0.001 + 0.0005 * std::sin(9.0 * t),
             0.05 * std::sin(4.0 * t), 0.5 * std::sin(2.0 * t)),
        {{kFrame, Eigen::Isometry3d::Identity()}}};
    workpieces[0] = sheets[static_cast<size_t>(i * kUpdates / kPoses)];
    sweeps[second] += processorTime([&] { guard.sweep(at, workpieces, report); }) / kPoses;
    if (i % kPredictionPeriod == 0) {
      predictions.push_back(processorTime([&] { guard.predict(0ms, workpieces, prediction); }));
    }
    contacts.push_back(static_cast<double>(report.objects.at(0).result.in_contact.size()));
  }
  const auto row = [&](const char* what, const std::vector<double>& times) {
    return makeRow("guard in contact", std::string(presser.name) + ", " + what,
                   static_cast<size_t>(quantile(contacts, 0.5)), 1, times);
  };
  return {row("sweep per pose", sweeps), row("prediction", predictions)};
}

int run(const std::vector<std::string>& arguments) {
  const bool has_csv = arguments.size() == 2 && arguments[0] == "--csv";
  if (!arguments.empty() && !has_csv) throw InvalidInput("usage: contact_patch [--csv FILE]");
  ResultFile results(has_csv ? arguments[1] : "");
  const auto report = [&](const std::vector<Row>& rows, const char* unit) {
    for (const Row& row : rows) {
      std::printf("%s, %s: %.3f us%s (%.3f to %.3f), %zu triangles\n", row.work.c_str(), row.method.c_str(),
                  row.median_us, unit, row.p10_us, row.p90_us, row.triangles);
      std::fflush(stdout);
      results.write(row);
    }
  };
  for (const Presser& presser : pressers()) {
    report(narrowPhase(presser), " per triangle in contact");
    report(wholeGuard(presser), "");
  }
  return 0;
}

}  // namespace
}  // namespace sweep_guard_benchmark

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("contact_patch", [&] {
    return sweep_guard_benchmark::run({argv + 1, argv + argc});
  });
}
