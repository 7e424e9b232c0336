#include "sweep_guard/guard/path_test.h"

#include <algorithm>
#include <iterator>

#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

constexpr Duration kProbableStretch = std::chrono::milliseconds(25);  // what might meet is not told more finely

}  // namespace

struct PathTest::Scene {
  Detector& detector;
  const Tool& tool;
  const ExpectedMotion& motion;
  const TriangleMesh& mesh_M;
  double margin;  // the tool is grown by this
};

// So far along the path.
struct PathTest::Findings {
  std::vector<PredictedSweep> sweeps;
  bool met = false;
  TriangleSet triangles;  // of the sweep that is tested
};

PredictedObject PathTest::operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT,
                                     const PredictedPath& path, size_t reflex_sweeps, const Eigen::Isometry3d& X_WM,
                                     std::shared_ptr<const Workpiece> workpiece) {
  const TriangleMesh& mesh_M = workpiece->mesh_M;
  const ExpectedMotion motion(tool, X_WT, path, X_WM);
  const Scene scene{detector, tool, motion, mesh_M, options_.sweep.margin + mesh_M.rounding()};
  const MeshPart part = partWithin(mesh_M, motion.reach_M(motion.whole(), kMostDeviations, scene.margin));
  PredictedObject object{workpiece, {}, {}, {}, {}};
  Findings findings;
  for (size_t end = 1; end <= path.size(); ++end) {
    const Stretch sweep = motion.between(end - 1, end);
    std::vector<SweptVolume> volumes_M = volumesOf(scene, sweep);
    findings.triangles.clear();
    test(scene, part, sweep, volumes_M, findings);
    TriangleSet& met = end <= reflex_sweeps ? object.reflex : object.considered;
    met = united(met, findings.triangles);
    std::move(volumes_M.begin(), volumes_M.end(), std::back_inserter(object.volumes_M));
  }
  object.sweeps = std::move(findings.sweeps);
  object.considered = without(object.considered, object.reflex);
  return object;
}

std::vector<SweptVolume> PathTest::volumesOf(const Scene& scene, const Stretch& stretch) const {
  std::vector<SweptVolume> volumes_M;
  for (const Motion& part_M : scene.motion.motions_M(stretch, options_.sweep.max_rotation)) {
    volumes_M.push_back(sweptVolume(scene.tool, part_M, options_.sweep.volume, scene.margin));
  }
  return volumes_M;
}

// That the tool meets something in the stretch, and which of its volumes the planes do not tell apart from the mesh.
double PathTest::probability(const Scene& scene, const MeshPart& part, const Stretch& stretch,
                             const std::vector<SweptVolume>& volumes_M, std::vector<const SweptVolume*>& unseparated) {
  if (part.triangles.empty()) return 0.0;
  const Eigen::Isometry3d X_MT = scene.motion.end_M(stretch);
  const Matrix6d covariance_M = scene.motion.covariance_M(stretch);
  double largest = 0.0;
  for (const SweptVolume& volume_M : volumes_M) {
    const auto deviations = planeDeviations(scene.tool, X_MT, covariance_M, volume_M);
    const auto clearance = meter_(scene.mesh_M, part, volume_M, deviations);
    if (!clearance) continue;
    largest = std::max(largest, contactProbability(clearance->deviations));
    if (!clearance->separated) unseparated.push_back(&volume_M);
  }
  return largest;
}

// @param around  triangles that the tool may reach; those that it may reach in this stretch are among them
void PathTest::test(const Scene& scene, const MeshPart& around, const Stretch& stretch,
                    const std::vector<SweptVolume>& volumes_M, Findings& findings) {
  const MeshPart part = partWithin(scene.mesh_M, around, scene.motion.reach_M(stretch, kMostDeviations, scene.margin));
  const Duration length = stretch.to - stretch.from;
  const auto halve = [&] {
    const auto [first, second] = scene.motion.halves(stretch);
    test(scene, part, first, volumesOf(scene, first), findings);
    test(scene, part, second, volumesOf(scene, second), findings);
  };

  std::vector<const SweptVolume*> unseparated;
  const double probable = probability(scene, part, stretch, volumes_M, unseparated);
  if (probable > 0.0 && !findings.met && length > std::max(kProbableStretch, options_.finest)) return halve();

  TriangleSet met;
  for (const SweptVolume* volume_M : unseparated) {
    met = united(met, scene.detector.detect(scene.mesh_M, *volume_M).triangles);
  }
  if (!met.empty() && !findings.met && length > options_.finest) return halve();

  findings.sweeps.push_back({stretch.from, !met.empty(), probable});
  findings.met = findings.met || !met.empty();
  findings.triangles = united(findings.triangles, met);
}

}  // namespace sweep_guard
