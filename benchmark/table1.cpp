// Prints Table 1 of the paper for this machine.
//   table1 [--csv FILE]
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "common/rotation_between.h"
#include "common/run_program.h"
#include "drill.h"
#include "microseconds.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/quantile.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {
namespace {

constexpr int kMotions = 100;
constexpr int kRepetitions = 20;
constexpr std::array<VolumeKind, 2> kKinds = {VolumeKind::kObb, VolumeKind::kObbPlanes};

// A drill points into the hull and moves like a hand. Its tip is from 5 mm below to 20 mm above the surface.
Motion drilling(Random& random) {
  const Eigen::Vector3d outwards = random.direction();
  const Eigen::Vector3d axis = (-outwards + 0.5 * random.direction()).normalized();
  const Motion step = handMotion(random);
  const Eigen::Matrix3d turn = step.X_MT_end.linear() * step.X_MT_start.linear().transpose();
  Motion motion;
  motion.X_MT_start.linear() = rotationBetween(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  motion.X_MT_start.translation() = random.uniform(0.095, 0.12) * outwards;
  motion.X_MT_end.linear() = turn * motion.X_MT_start.linear();
  motion.X_MT_end.translation() = motion.X_MT_start.translation() + step.X_MT_end.translation();
  return motion;
}

struct Variant {
  std::string name;
  std::unique_ptr<Detector> detector;
  VolumeKind kind;
  std::vector<double> set_up = {};  // [ms]
  std::vector<double> query = {};   // [ms]
  std::vector<double> both = {};    // [ms]
  size_t hits = 0;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const VolumeKind kind : kKinds) {
    for (const std::string& name : detectorNames()) all.push_back({name, makeDetector(name), kind});
    all.push_back({"select, no cull", makeDetector("select", {/*cull=*/false}), kind});
    all.push_back({"select, on egl", makeDetector("select", {/*cull=*/true, "egl"}), kind});
    // Every triangle is drawn under a name of its own.
    const DetectorOptions paper{/*cull=*/false, "osmesa", /*triangles_per_name=*/1};
    all.push_back({"select, as in the paper", makeDetector("select", paper), kind});
  }
  std::stable_sort(all.begin(), all.end(), [](const Variant& a, const Variant& b) { return a.name < b.name; });
  return all;
}

void measure(Variant& variant, const ConvexShape& tool, const TriangleMesh& mesh, const Motion& motion) {
  SweptVolume swept_M;
  variant.set_up.push_back(1e-3 *
                           microseconds([&] { swept_M = sweptVolume(tool, motion, variant.kind, mesh.rounding()); }));
  const Detection* found = nullptr;
  variant.query.push_back(1e-3 * microseconds([&] { found = &variant.detector->detect(mesh, swept_M); }));
  variant.both.push_back(variant.set_up.back() + variant.query.back());
  variant.hits += found->triangles.size();
}

// The variants take turns, in another order in each repetition, so that a busy machine slows all of them equally.
std::vector<Variant> timesOn(const TriangleMesh& mesh) {
  const ConvexShape tool = drill();
  Random random(/*seed=*/1);
  std::vector<Motion> motions;
  motions.reserve(kMotions);
  for (int i = 0; i < kMotions; ++i) motions.push_back(drilling(random));

  std::vector<Variant> measured = variants();
  std::vector<Variant> warm_up = variants();
  for (size_t i = 0; i < measured.size(); ++i) {
    measure(warm_up[i], tool, mesh, motions[0]);
    measured[i].detector = std::move(warm_up[i].detector);
  }
  for (size_t repetition = 0; repetition < kRepetitions; ++repetition) {
    for (const Motion& motion : motions) {
      for (size_t i = 0; i < measured.size(); ++i) {
        measure(measured[(i + repetition) % measured.size()], tool, mesh, motion);
      }
    }
  }
  return measured;
}

double papersTime(size_t triangles, VolumeKind kind) {  // [ms]
  if (triangles == 400) return kind == VolumeKind::kObb ? 0.61 : 0.85;
  return kind == VolumeKind::kObb ? 1.48 : 2.21;
}

void printTimes(const TriangleMesh& mesh, std::ostream& csv) {
  const size_t triangles = mesh.triangles().size();
  std::printf("\n%zu triangles            volume       set-up    query     both   (p10 to p90)      hits   paper\n",
              triangles);
  for (const Variant& variant : timesOn(mesh)) {
    const double hits = static_cast<double>(variant.hits) / (kMotions * kRepetitions);
    const double paper = papersTime(triangles, variant.kind);
    const std::array<double, 5> times = {quantile(variant.set_up, 0.5), quantile(variant.query, 0.5),
                                         quantile(variant.both, 0.5), quantile(variant.both, 0.1),
                                         quantile(variant.both, 0.9)};
    std::printf("%-24s  %-10s %8.4f %8.4f %8.4f (%.4f to %.4f) %6.1f %7.2f\n", variant.name.c_str(),
                nameOf(variant.kind).c_str(), times[0], times[1], times[2], times[3], times[4], hits, paper);
    csv << triangles << ",\"" << variant.name << "\"," << nameOf(variant.kind);
    for (const double time : times) csv << ',' << time;
    csv << ',' << hits << ',' << paper << '\n';
  }
}

int run(const std::vector<std::string>& arguments) {
  std::ofstream csv;
  if (arguments.size() == 2 && arguments[0] == "--csv") {
    csv.open(arguments[1]);
    if (!csv) throw InvalidInput("cannot write " + arguments[1]);
  } else if (!arguments.empty()) {
    throw InvalidInput("usage: table1 [--csv FILE]");
  }
  csv << "triangles,detector,volume,set_up_ms,query_ms,both_ms,both_p10_ms,both_p90_ms,hits,paper_ms\n";
  const ConvexShape tool = drill();
  std::printf(
      "Time of one detection, medians [ms]: a drill of %.0f x %.0f mm at the surface of a wavy hull, %d motions\n",
      2e3 * tool.radius(), 1e3 * tool.length(), kMotions);
  std::printf("of 1 to 20 mm and 0 to 10 degrees, %d times each. hits: triangles per motion. paper: [P, Table 1], a\n",
              kRepetitions);
  std::printf("Pentium III of 866 MHz with an ELSA Gloria II Pro; a scale, not a competitor.\n");
  printTimes(wavyHull(/*rings=*/11, /*sectors=*/20, /*phase=*/0.0), csv);
  printTimes(wavyHull(/*rings=*/21, /*sectors=*/40, /*phase=*/0.0), csv);
  return 0;
}

}  // namespace
}  // namespace sweep_guard_core

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram(
      "table1",
      [&] {
        return sweep_guard_core::run({argv + 1, argv + argc});
      },
      /*failed=*/1);
}
