// Prints Table 1 of the paper for this machine.
//   table1 [--csv FILE]
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "detection/select_detector.h"
#include "sample.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {
namespace {

constexpr int kMotions = 100;
constexpr int kRepetitions = 20;
constexpr std::array<VolumeKind, 2> kKinds = {VolumeKind::kObb, VolumeKind::kObbPlanes};

ConvexShape drill() { return ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1); }

// A drill that points into the hull, its tip from 5 mm below to 20 mm above the surface, and moves as a hand does.
Motion drilling(Random& random) {
  const Eigen::Vector3d outwards = random.direction();
  const Eigen::Vector3d axis = (-outwards + 0.5 * random.direction()).normalized();
  const Motion step = handMotion(random);
  const Eigen::Matrix3d turn = step.X_MT_end.linear() * step.X_MT_start.linear().transpose();
  Motion motion;
  motion.X_MT_start.linear() = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  motion.X_MT_start.translation() = random.uniform(0.095, 0.12) * outwards;
  motion.X_MT_end.linear() = turn * motion.X_MT_start.linear();
  motion.X_MT_end.translation() = motion.X_MT_start.translation() + step.X_MT_end.translation();
  return motion;
}

struct Variant {
  std::string name;
  std::unique_ptr<Detector> detector;
  VolumeKind kind;
  Sample set_up;  // [ms]
  Sample query;   // [ms]
  Sample both;    // [ms]
  size_t hits = 0;
};

std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const VolumeKind kind : kKinds) {
    for (const std::string& name : detectorNames()) all.push_back({name, makeDetector(name), kind, {}, {}, {}, 0});
    all.push_back({"select, no cull", makeDetector("select", {/*cull=*/false}), kind, {}, {}, {}, 0});
    all.push_back({"select, on egl", makeDetector("select", {/*cull=*/true, "egl"}), kind, {}, {}, {}, 0});
    // A name for each triangle, and every triangle drawn.
    const SelectDetector::Options papers{{/*cull=*/false}, /*block=*/1};
    all.push_back({"select, the paper's way", std::make_unique<SelectDetector>(papers), kind, {}, {}, {}, 0});
  }
  std::stable_sort(all.begin(), all.end(), [](const Variant& a, const Variant& b) { return a.name < b.name; });
  return all;
}

void measure(Variant& variant, const ConvexShape& tool, const TriangleMesh& mesh, const Motion& motion) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto start = Clock::now();
  const SweptVolume swept_M = sweptVolume(tool, motion, variant.kind, mesh.rounding());
  const auto set_up = Clock::now();
  const Detection detection = variant.detector->detect(mesh, swept_M);
  const auto end = Clock::now();
  variant.set_up.add(Milliseconds(set_up - start).count());
  variant.query.add(Milliseconds(end - set_up).count());
  variant.both.add(Milliseconds(end - start).count());
  variant.hits += detection.triangles.size();
}

// The variants take turns, each repetition in another order, so that a busy machine slows them all alike.
std::vector<Variant> run(const TriangleMesh& mesh) {
  const ConvexShape tool = drill();
  Random random(/*seed=*/1);
  std::vector<Motion> motions;
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
  for (const Variant& variant : run(mesh)) {
    const double hits = static_cast<double>(variant.hits) / (kMotions * kRepetitions);
    const double paper = papersTime(triangles, variant.kind);
    std::printf("%-24s  %-10s %8.4f %8.4f %8.4f (%.4f to %.4f) %6.1f %7.2f\n", variant.name.c_str(),
                nameOf(variant.kind).c_str(), variant.set_up.quantile(0.5), variant.query.quantile(0.5),
                variant.both.quantile(0.5), variant.both.quantile(0.1), variant.both.quantile(0.9), hits, paper);
    csv << triangles << ",\"" << variant.name << "\"," << nameOf(variant.kind) << ',' << variant.set_up.quantile(0.5)
        << ',' << variant.query.quantile(0.5) << ',' << variant.both.quantile(0.5) << ',' << variant.both.quantile(0.1)
        << ',' << variant.both.quantile(0.9) << ',' << hits << ',' << paper << '\n';
  }
}

int main(const std::vector<std::string>& arguments) {
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
  try {
    return sweep_guard_core::main({argv + 1, argv + argc});
  } catch (const sweep_guard_core::Error& error) {
    std::cerr << "table1: " << error.what() << '\n';
    return 1;
  }
}
