#include "sweep_guard/guard/path_test.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "sweep_guard/detection/float_planes.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

constexpr Duration kProbableStretch = std::chrono::milliseconds(25);  // what might meet is not told more finely

std::vector<size_t> everyPose(size_t count) {
  std::vector<size_t> ends(count);
  std::iota(ends.begin(), ends.end(), 1);
  return ends;
}

}  // namespace

struct PathTest::Scene {
  Detector& detector;
  const Tool& tool;
  const ExpectedMotion& motion;
  const TriangleMesh& mesh_M;
  double margin;        // the tool is grown by this
  Duration reflex_end;  // after the newest pose
  const std::function<bool()>& spent;

  bool inTimeFor(const Stretch& stretch) const { return stretch.to <= reflex_end || !spent || !spent(); }
};

// What the planes of a stretch's volumes tell.
struct PathTest::Reading {
  double probability = 0.0;            // that the tool meets something
  std::vector<SweptBody> unseparated;  // parts of the tool not told apart from the mesh
  TriangleSet triangles;               // that these may meet
};

// So far along the path.
struct PathTest::Findings {
  std::vector<PredictedSweep> sweeps;
  bool met = false;
  TriangleSet triangles;  // of the sweep that is tested
  size_t volumes_tested = 0;
};

PredictedObject PathTest::operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT,
                                     const PredictedPath& path, size_t reflex_sweeps, const Eigen::Isometry3d& X_WM,
                                     std::shared_ptr<const Workpiece> workpiece, const Effort& effort) {
  const TriangleMesh& mesh_M = workpiece->mesh_M;
  const ExpectedMotion motion(tool, X_WT, path, X_WM);
  const Duration reflex_end = reflex_sweeps == 0 ? Duration::zero() : path[reflex_sweeps - 1].ahead;
  const double margin = options_.sweep.margin + mesh_M.rounding();
  const Scene scene{detector, tool, motion, mesh_M, margin, reflex_end, effort.spent};
  const MeshPart part = partInReach(scene, mesh_M, motion.whole(), 0);
  PredictedObject object{workpiece, {}, {}, {}, {}};
  Findings findings;
  size_t begin = 0;
  for (const size_t end : effort.sweep_ends.empty() ? everyPose(path.size()) : effort.sweep_ends) {
    const Stretch sweep = motion.between(begin, end);
    std::vector<SweptBody> whole = wholeTool(scene, sweep);
    findings.triangles.clear();
    test(scene, part, sweep, whole, findings, 1);
    TriangleSet& met = end <= reflex_sweeps ? object.reflex : object.considered;
    met = united(met, findings.triangles);
    for (SweptBody& body : whole) object.volumes_M.push_back(std::move(body.volume_M));
    begin = end;
  }
  object.sweeps = std::move(findings.sweeps);
  object.volumes_tested = findings.volumes_tested;
  object.considered = without(object.considered, object.reflex);
  return object;
}

TriangleSet PathTest::detected(const Scene& scene, const MeshPart& part, const std::vector<SweptBody>& bodies) {
  TriangleSet met;
  for (const SweptBody& body : bodies) {
    detect(scene.detector, part, body, detection_);
    met = united(met, detection_.triangles);
  }
  return met;
}

MeshPart PathTest::partInReach(const Scene& scene, const MeshPart& around, const Stretch& stretch, size_t halvings) {
  while (finders_.size() <= halvings) finders_.emplace_back();
  const Eigen::AlignedBox3d reach_M = scene.motion.reach_M(stretch, kMostDeviations, scene.margin);
  return finders_[halvings](around, floatPlanes(scene.mesh_M, reach_M));
}

std::vector<SweptBody> PathTest::wholeTool(const Scene& scene, const Stretch& stretch) const {
  std::vector<SweptBody> whole;
  for (const Motion& motion_M : scene.motion.motions_M(stretch, options_.sweep.max_rotation)) {
    whole.push_back(sweptBody(scene.tool.whole(), motion_M, options_.sweep.volume, scene.margin));
  }
  return whole;
}

PathTest::Reading PathTest::read(const Scene& scene, const MeshPart& part, const Stretch& stretch,
                                 const std::vector<SweptBody>& whole) {
  Reading reading;
  if (part.empty()) return reading;
  for (const SweptBody& body : whole) read(scene, part, stretch, scene.tool.tree()[0], body, reading);
  return reading;
}

// Down the tool's tree, as far as its boxes might meet something.
void PathTest::read(const Scene& scene, const MeshPart& part, const Stretch& stretch, const Tool::Node& node,
                    const SweptBody& body, Reading& reading) {
  const auto deviations =
      planeDeviations(node.shape_T, scene.motion.end_M(stretch), scene.motion.covariance_M(stretch), body.volume_M);
  const auto clearance = meter_(part, body.volume_M, deviations);
  if (!clearance) return;
  if (!node.part) {
    for (const size_t index : node.below) {
      const Tool::Node& below = scene.tool.tree()[index];
      const SweptBody within = sweptBody(below.shape_T, body.motion_M, options_.sweep.volume, scene.margin);
      read(scene, part, stretch, below, within, reading);
    }
    return;
  }
  reading.probability = std::max(reading.probability, contactProbability(clearance->deviations));
  if (clearance->separated) return;
  reading.unseparated.push_back(body);
  reading.triangles = united(reading.triangles, meter_.notSeparated());
}

// @param around  triangles that the tool may reach; those that it may reach in this stretch are among them
void PathTest::test(const Scene& scene, const MeshPart& around, const Stretch& stretch,
                    const std::vector<SweptBody>& whole, Findings& findings, size_t halvings) {
  const MeshPart part = partInReach(scene, around, stretch, halvings);
  const Duration length = stretch.to - stretch.from;
  const auto halve = [&] {
    const auto [first, second] = scene.motion.halves(stretch);
    test(scene, part, first, wholeTool(scene, first), findings, halvings + 1);
    test(scene, part, second, wholeTool(scene, second), findings, halvings + 1);
  };

  const Reading reading = read(scene, part, stretch, whole);
  const bool in_time = reading.probability == 0.0 || scene.inTimeFor(stretch);
  const bool finer = !findings.met && in_time;
  if (in_time) findings.volumes_tested += whole.size();
  if (reading.probability > 0.0 && finer && length > std::max(kProbableStretch, options_.finest)) return halve();
  const TriangleSet met = in_time ? detected(scene, part, reading.unseparated) : reading.triangles;
  if (!met.empty() && finer && length > options_.finest) return halve();

  findings.sweeps.push_back({stretch.from, !met.empty(), reading.probability});
  findings.met = findings.met || !met.empty();
  findings.triangles = united(findings.triangles, met);
}

}  // namespace sweep_guard
