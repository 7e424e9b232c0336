#include "guard/path_checker.h"

#include <algorithm>

#include "guard/placed_workpieces.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kFinestProbable = std::chrono::milliseconds(25);  // shortest sweep with a merely possible contact

}  // namespace

struct PathChecker::Scene {
  Detector& detector;
  const Tool& tool;
  double margin;        // the tool is grown by this
  Duration reflex_end;  // after the newest pose
  const std::function<bool()>& out_of_time;

  bool inTimeFor(const PathSegment& segment) const {
    return segment.to <= reflex_end || !out_of_time || !out_of_time();
  }
};

struct PathChecker::Progress {
  PredictedObject& object;
  TriangleSet* triangles;  // of the interval under test
  bool contact = false;    // found in an earlier segment
};

void PathChecker::check(Detector& detector, const PredictedPathRequest& request, PredictedObject& object) {
  object.clear();
  object.workpiece = request.workpiece;
  path_M_.follow(request.tool, request.X_WT, request.path, request.X_WM);
  const TriangleMesh& mesh_M = object.workpiece->mesh_M;
  const double margin = options_.sweep.margin + mesh_M.rounding();
  const size_t reflex_sweeps = request.reflex_sweeps;
  const Duration reflex_end = reflex_sweeps == 0 ? Duration::zero() : request.path[reflex_sweeps - 1].ahead;
  const Scene scene{detector, request.tool, margin, reflex_end, request.plan.out_of_time};
  const Submesh submesh = submeshInReach(scene, mesh_M, path_M_.whole(), 0);
  Progress progress{object, &object.reflex};
  size_t begin = 0;
  for (size_t i = 0; i < request.plan.sweepCount(request.path); ++i) {
    const size_t end = request.plan.sweep_ends.empty() ? i + 1 : request.plan.sweep_ends[i];
    const PathSegment sweep = path_M_.between(begin, end);
    request.plan.before_sweep();
    sweepSegment(scene, sweep);
    for (const SweptBody& body : bodies_) object.volumes_M.push_back(body.volume_M);
    if (end > reflex_sweeps) progress.triangles = &object.considered;
    checkSegment(scene, submesh, sweep, progress, 1);
    begin = end;
  }
  remove(object.considered, object.reflex);
}

void PathChecker::predict(Detector& detector, const PredictionRequest& request, const SweepPlan& plan,
                          Prediction& prediction) {
  static const Workpieces kNone;
  const PredictedMotion& motion = request.motion;
  prediction.stamp = motion.from.stamp;
  prediction.path = motion.path;
  prediction.reflex_sweeps = motion.reflex_sweeps;
  prediction.sweeps_asked = motion.path.size();
  prediction.sweeps_made = plan.sweepCount(motion.path);
  const auto test = [&](const auto& workpiece, const Eigen::Isometry3d& X_WM, PredictedObject& object) {
    check(detector, {request.tool, motion.from.X_WT, motion.path, motion.reflex_sweeps, X_WM, workpiece, plan}, object);
  };
  testPlaced(motion.path.empty() ? kNone : request.workpieces, motion.from, prediction, test);
}

Submesh PathChecker::submeshInReach(const Scene& scene, const Submesh& around, const PathSegment& segment,
                                    size_t halvings) {
  while (finders_.size() <= halvings) finders_.emplace_back();
  const Eigen::AlignedBox3d reach_M = path_M_.reach_M(segment, kMaxDeviations, scene.margin);
  return finders_[halvings].find(around, reach_M);
}

void PathChecker::sweepSegment(const Scene& scene, const PathSegment& segment) {
  path_M_.motions_M(segment, options_.sweep.max_rotation, motions_M_);
  bodies_.clear();
  for (const Motion& motion_M : motions_M_) {
    bodies_.push_back(sweptBody(scene.tool.whole(), motion_M, options_.sweep.volume, scene.margin));
  }
}

// Returns the likelier candidate; of two equal ones, the first.
const PathChecker::Candidate& PathChecker::likelier(const Candidate& one, const Candidate& other) {
  return other.probability > one.probability ? other : one;
}

// Finds the piece of the tool most likely to meet the mesh, and the pieces that no plane separates from the mesh.
PathChecker::Candidate PathChecker::findCandidate(const Scene& scene, const Submesh& submesh,
                                                  const PathSegment& segment) {
  unseparated_.clear();
  not_ruled_out_.clear();
  in_contact_ = {};
  Candidate candidate;
  if (submesh.empty()) return candidate;
  for (const SweptBody& body : bodies_) {
    candidate = likelier(candidate, findCandidate(scene, submesh, segment, scene.tool.tree()[0], body));
  }
  return candidate;
}

PathChecker::Candidate PathChecker::findCandidate(const Scene& scene, const Submesh& submesh,
                                                  const PathSegment& segment, const Tool::Node& node,
                                                  const SweptBody& body) {
  const auto deviations =
      planeDeviations(node.shape_T, path_M_.end_M(segment), path_M_.covariance_M(segment), body.volume_M);
  const auto clearance = meter_.measure(submesh, body.volume_M, deviations);
  if (!clearance) return {};
  if (node.piece) {
    const Candidate candidate{contactProbability(clearance->deviations), node.piece};
    if (!clearance->separated) {
      unseparated_.push_back({body, candidate});
      unite(not_ruled_out_, meter_.notSeparated());
      in_contact_ = likelier(in_contact_, candidate);
    }
    return candidate;
  }
  Candidate candidate;
  for (const size_t index : node.below) {
    const Tool::Node& below = scene.tool.tree()[index];
    const SweptBody within = sweptBody(below.shape_T, body.motion_M, options_.sweep.volume, scene.margin);
    candidate = likelier(candidate, findCandidate(scene, submesh, segment, below, within));
  }
  return candidate;
}

void PathChecker::detectContacts(const Scene& scene, const Submesh& submesh) {
  not_ruled_out_.clear();
  in_contact_ = {};
  for (const auto& [body, candidate] : unseparated_) {
    detect(scene.detector, submesh, body, detection_);
    unite(not_ruled_out_, detection_.triangles);
    if (!detection_.triangles.empty()) in_contact_ = likelier(in_contact_, candidate);
  }
}

// Requires sweepSegment() of this segment. Its halves replace it.
void PathChecker::checkSegment(const Scene& scene, const Submesh& around, const PathSegment& segment,
                               Progress& progress, size_t halvings) {
  const Submesh submesh = submeshInReach(scene, around, segment, halvings);
  const Duration length = segment.to - segment.from;
  const auto halve = [&] {
    const auto [first, second] = path_M_.halves(segment);
    for (const PathSegment& half : {first, second}) {
      sweepSegment(scene, half);
      checkSegment(scene, submesh, half, progress, halvings + 1);
    }
  };

  const Candidate candidate = findCandidate(scene, submesh, segment);
  const bool in_time = candidate.probability == 0.0 || scene.inTimeFor(segment);
  const bool finer = !progress.contact && in_time;
  if (in_time) progress.object.volumes_tested += bodies_.size();
  if (candidate.probability > 0.0 && finer && length > std::max(kFinestProbable, options_.finest)) return halve();
  if (in_time) detectContacts(scene, submesh);
  if (!not_ruled_out_.empty() && finer && length > options_.finest) return halve();

  const auto tool_piece = not_ruled_out_.empty() ? candidate.piece : in_contact_.piece;
  progress.object.sweeps.push_back({segment.from, !not_ruled_out_.empty(), candidate.probability, tool_piece});
  progress.contact = progress.contact || !not_ruled_out_.empty();
  unite(*progress.triangles, not_ruled_out_);
}

}  // namespace sweep_guard_core
