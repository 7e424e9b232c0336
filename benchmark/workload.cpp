#include "workload.h"

#include <algorithm>

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_benchmark {
namespace {

using sweep_guard_core::Motion;
using sweep_guard_core::Random;

constexpr double kDegree = 0.017453292519943295;
constexpr double kPhaseStep = 0.1;  // of the waves from frame to frame [rad]
constexpr int kTries = 40;

double phaseOf(size_t frame) { return kPhaseStep * static_cast<double>(frame); }

std::vector<Motion> motionsOf(Queries queries, const Hull& hull, Random& random, double phase, double depth) {
  if (queries == Queries::kNone) return {};
  if (queries == Queries::kSweep) return {hull.drilling(random, phase, depth, 0.02, 5.0 * kDegree)};
  return split(hull.drilling(random, phase, depth, 0.20, 50.0 * kDegree), 2.501 * kDegree);
}

// Makes a frame without its truth.
Frame makeFrame(std::vector<float> positions_M, std::vector<Motion> motions_M) {
  Frame frame;
  frame.positions_M = std::move(positions_M);
  frame.motions_M = std::move(motions_M);
  for (const Motion& motion_M : frame.motions_M) {
    frame.swept_M.push_back(sweptVolume(drill(), motion_M, sweep_guard_core::VolumeKind::kObbPlanes));
  }
  for (size_t i = 0; i < frame.swept_M.size(); ++i) {
    frame.volumes_M.push_back(polytope(frame.swept_M[i], frame.motions_M[i]));
  }
  return frame;
}

// Finds the triangles that each volume meets by clipping every triangle.
class Truth {
 public:
  explicit Truth(const Surface& surface)
      : mesh_M_(std::vector<Eigen::Vector3d>(surface.positions_M.size() / 3, Eigen::Vector3d::Zero()),
                {surface.triangles.begin(), surface.triangles.end()}),
        reference_(sweep_guard_core::makeDetector("reference")) {}

  std::vector<TriangleIds> find(const Frame& frame) {
    std::vector<TriangleIds> truth;
    if (frame.swept_M.empty()) return truth;
    std::vector<float> positions_M = frame.positions_M;
    mesh_M_.deform(positions_M);
    for (const sweep_guard_core::SweptVolume& swept_M : frame.swept_M) {
      truth.push_back(reference_->detect(mesh_M_, swept_M).triangles);
    }
    return truth;
  }

 private:
  sweep_guard_core::TriangleMesh mesh_M_;
  std::unique_ptr<sweep_guard_core::Detector> reference_;
};

}  // namespace

double Workload::hits() const {
  size_t hits = 0;
  for (const Frame& frame : frames) {
    for (const TriangleIds& ids : frame.truth) hits += ids.size();
  }
  return static_cast<double>(hits) / static_cast<double>(frames.size());
}

Workload ordinary(const Hull& hull, Queries queries, size_t frames) {
  Random random(/*seed=*/1);
  Workload workload{"ordered", hull.surface(phaseOf(0)), 0, {}};
  Truth truth(workload.surface);
  for (size_t i = 0; i < frames; ++i) {
    const double depth = random.uniform(-0.005, 0.015);
    std::vector<Motion> motions_M = motionsOf(queries, hull, random, phaseOf(i), depth);
    workload.frames.push_back(makeFrame(hull.surface(phaseOf(i)).positions_M, std::move(motions_M)));
    workload.frames.back().truth = truth.find(workload.frames.back());
  }
  workload.queries = workload.frames.front().volumes_M.size();
  return workload;
}

Workload shuffled(Workload workload) {
  const Order order = randomOrder(workload.surface);
  std::vector<std::uint32_t> place(order.triangles.size());
  for (std::uint32_t i = 0; i < place.size(); ++i) place[order.triangles[i]] = i;
  for (Frame& frame : workload.frames) {
    frame.positions_M = reordered({std::move(frame.positions_M), workload.surface.triangles}, order).positions_M;
    for (TriangleIds& ids : frame.truth) {
      for (std::uint32_t& id : ids) id = place[id];
      std::sort(ids.begin(), ids.end());
    }
  }
  workload.surface = reordered(workload.surface, order);
  workload.name = "shuffled";
  return workload;
}

Workload grazing(const Hull& hull, size_t hits, size_t frames) {
  Workload workload{hits == 0 ? "no hit" : "one hit", hull.surface(phaseOf(0)), 1, {}};
  Truth truth(workload.surface);
  for (std::uint64_t seed = 1; workload.frames.size() < frames; ++seed) {
    const double phase = phaseOf(workload.frames.size());
    double outside = -0.05;  // [m]
    double inside = 0.01;    // [m]
    for (int i = 0; i < kTries; ++i) {
      Random random(seed);
      const double depth = 0.5 * (outside + inside);
      Frame frame = makeFrame(hull.surface(phase).positions_M, motionsOf(Queries::kSweep, hull, random, phase, depth));
      frame.truth = truth.find(frame);
      const size_t found = frame.truth[0].size();
      if (found == hits) {
        workload.frames.push_back(std::move(frame));
        break;
      }
      (found > hits ? inside : outside) = depth;
    }
  }
  return workload;
}

}  // namespace sweep_guard_benchmark
