#include "sweep_guard/guard/path_test.h"

#include <algorithm>

#include "sweep_guard/detection/float_planes.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

constexpr Duration kProbableStretch = std::chrono::milliseconds(25);  // what might meet is not told more finely

}  // namespace

struct PathTest::Scene {
  Detector& detector;
  const Tool& tool;
  const TriangleMesh& mesh_M;
  double margin;        // the tool is grown by this
  Duration reflex_end;  // after the newest pose
  const std::function<bool()>& spent;

  bool inTimeFor(const Stretch& stretch) const { return stretch.to <= reflex_end || !spent || !spent(); }
};

// So far along the path.
struct PathTest::Findings {
  PredictedObject& object;
  TriangleSet* met;  // of its intervals, the one that is tested
  bool any_met = false;
};

void PathTest::operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT,
                          const PredictedPath& path, size_t reflex_sweeps, const Eigen::Isometry3d& X_WM,
                          std::shared_ptr<const Workpiece> workpiece, const Effort& effort, PredictedObject& object) {
  object.clear();
  object.workpiece = std::move(workpiece);
  motion_.follow(tool, X_WT, path, X_WM);
  const TriangleMesh& mesh_M = object.workpiece->mesh_M;
  const Duration reflex_end = reflex_sweeps == 0 ? Duration::zero() : path[reflex_sweeps - 1].ahead;
  const Scene scene{detector, tool, mesh_M, options_.sweep.margin + mesh_M.rounding(), reflex_end, effort.spent};
  const MeshPart part = partInReach(scene, mesh_M, motion_.whole(), 0);
  Findings findings{object, &object.reflex};
  size_t begin = 0;
  for (size_t i = 0; i < effort.sweepsAlong(path); ++i) {
    const size_t end = effort.sweep_ends.empty() ? i + 1 : effort.sweep_ends[i];
    const Stretch sweep = motion_.between(begin, end);
    sweepWhole(scene, sweep);
    for (const SweptBody& body : whole_) object.volumes_M.push_back(body.volume_M);
    if (end > reflex_sweeps) findings.met = &object.considered;
    test(scene, part, sweep, findings, 1);
    begin = end;
  }
  remove(object.considered, object.reflex);
}

MeshPart PathTest::partInReach(const Scene& scene, const MeshPart& around, const Stretch& stretch, size_t halvings) {
  while (finders_.size() <= halvings) finders_.emplace_back();
  const Eigen::AlignedBox3d reach_M = motion_.reach_M(stretch, kMostDeviations, scene.margin);
  return finders_[halvings](around, floatPlanes(scene.mesh_M, reach_M));
}

void PathTest::sweepWhole(const Scene& scene, const Stretch& stretch) {
  motion_.motions_M(stretch, options_.sweep.max_rotation, motions_M_);
  whole_.clear();
  for (const Motion& motion_M : motions_M_) {
    whole_.push_back(sweptBody(scene.tool.whole(), motion_M, options_.sweep.volume, scene.margin));
  }
}

// The first of two alike.
const PathTest::Chance& PathTest::likelier(const Chance& one, const Chance& other) {
  return other.probability > one.probability ? other : one;
}

// What the planes tell: the part of the tool that is likeliest to meet something, and what is not told apart.
PathTest::Chance PathTest::read(const Scene& scene, const MeshPart& part, const Stretch& stretch) {
  unseparated_.clear();
  met_.clear();
  meeting_ = {};
  Chance chance;
  if (part.empty()) return chance;
  for (const SweptBody& body : whole_) {
    chance = likelier(chance, read(scene, part, stretch, scene.tool.tree()[0], body));
  }
  return chance;
}

// Down the tool's tree, as far as its boxes might meet something.
PathTest::Chance PathTest::read(const Scene& scene, const MeshPart& part, const Stretch& stretch,
                                const Tool::Node& node, const SweptBody& body) {
  const auto deviations =
      planeDeviations(node.shape_T, motion_.end_M(stretch), motion_.covariance_M(stretch), body.volume_M);
  const auto clearance = meter_(part, body.volume_M, deviations);
  if (!clearance) return {};
  if (node.part) {
    const Chance chance{contactProbability(clearance->deviations), node.part};
    if (!clearance->separated) {
      unseparated_.push_back({body, chance});
      unite(met_, meter_.notSeparated());
      meeting_ = likelier(meeting_, chance);
    }
    return chance;
  }
  Chance chance;
  for (const size_t index : node.below) {
    const Tool::Node& below = scene.tool.tree()[index];
    const SweptBody within = sweptBody(below.shape_T, body.motion_M, options_.sweep.volume, scene.margin);
    chance = likelier(chance, read(scene, part, stretch, below, within));
  }
  return chance;
}

void PathTest::detectMet(const Scene& scene, const MeshPart& part) {
  met_.clear();
  meeting_ = {};
  for (const auto& [body, chance] : unseparated_) {
    detect(scene.detector, part, body, detection_);
    unite(met_, detection_.triangles);
    if (!detection_.triangles.empty()) meeting_ = likelier(meeting_, chance);
  }
}

// Of a stretch whose volumes are made. A half takes the place of the whole: nothing is asked of that any more.
// @param around  triangles that the tool may reach; those that it may reach in this stretch are among them
void PathTest::test(const Scene& scene, const MeshPart& around, const Stretch& stretch, Findings& findings,
                    size_t halvings) {
  const MeshPart part = partInReach(scene, around, stretch, halvings);
  const Duration length = stretch.to - stretch.from;
  const auto halve = [&] {
    const auto [first, second] = motion_.halves(stretch);
    for (const Stretch& half : {first, second}) {
      sweepWhole(scene, half);
      test(scene, part, half, findings, halvings + 1);
    }
  };

  const Chance chance = read(scene, part, stretch);
  const bool in_time = chance.probability == 0.0 || scene.inTimeFor(stretch);
  const bool finer = !findings.any_met && in_time;
  if (in_time) findings.object.volumes_tested += whole_.size();
  if (chance.probability > 0.0 && finer && length > std::max(kProbableStretch, options_.finest)) return halve();
  if (in_time) detectMet(scene, part);
  if (!met_.empty() && finer && length > options_.finest) return halve();

  const auto tool_part = met_.empty() ? chance.part : meeting_.part;
  findings.object.sweeps.push_back({stretch.from, !met_.empty(), chance.probability, tool_part});
  findings.any_met = findings.any_met || !met_.empty();
  unite(*findings.met, met_);
}

}  // namespace sweep_guard
