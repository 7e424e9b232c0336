#include "guard/path_checker.h"

#include <algorithm>
#include <cmath>

#include "common/heartbeat.h"
#include "common/stage_clock.h"
#include "guard/moving_mesh.h"
#include "guard/placed_workpieces.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Duration kFinestProbable = std::chrono::milliseconds(25);  // shortest sweep with a merely possible contact

constexpr double kRounding = 1e-9;  // relative, of a reach

void leaveOut(TriangleSet& triangles, const IsLeftOut& is_left_out) {
  if (is_left_out)
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), std::ref(is_left_out)), triangles.end());
}

// Of the mesh as sent, which lies within its rounding of what is stored.
double radiusAboutFrame(const TriangleMesh& mesh_M) {
  return mesh_M.origin().norm() + mesh_M.radius() + mesh_M.rounding();
}

}  // namespace

struct PathChecker::Scene {
  Detector& detector;
  const Tool& tool;
  double margin;        // the tool is grown by this
  Duration reflex_end;  // after the newest pose
  const SweepPlan& plan;
  const Workpiece& workpiece;
  const IntendedContact& intended;
  const IntendedTouches& touches;
  const AllowedPieces& allowed;

  bool mayTouch(const Tool::Node& node) const { return node.piece && allowed.contains(*node.piece); }
  bool inTimeFor(const PathSegment& segment) const {
    return segment.to <= reflex_end || !plan.out_of_time || !plan.out_of_time();
  }
  bool hasTouched(size_t piece) const {
    return !intended.empty() && touches.contains(workpiece.id, tool.pieces()[piece].link);
  }
};

size_t PathChecker::indexOf(const Scene& scene, const Tool::Node& node) {
  return static_cast<size_t>(&node - scene.tool.tree().data());
}

struct PathChecker::Progress {
  PredictedObject& object;
  ClosestApproach& closest;
  TriangleSet* triangles;  // of the interval under test
  bool contact = false;    // found in an earlier segment
};

void PathChecker::check(Detector& detector, const PredictedPathRequest& request, PredictedObject& object) {
  X_WM_.reset();
  own_closest_.clear();
  checkNext(detector, request, object);
}

void PathChecker::checkNext(Detector& detector, const PredictedPathRequest& request, PredictedObject& object) {
  object.clear();
  object.workpiece = request.workpiece;
  const TriangleMesh& mesh_M = object.workpiece->mesh_M;
  const double margin = options_.sweep.margin + mesh_M.rounding();
  const bool several = request.closest != nullptr && request.frame == nullptr;
  if (several && staysOutOfReach(request, margin)) return addFreeSweeps(request, object);
  follow(request, margin);
  const size_t reflex_sweeps = request.reflex_sweeps;
  const Duration reflex_end = reflex_sweeps == 0 ? Duration::zero() : request.path[reflex_sweeps - 1].ahead;
  const IntendedContact intended(request.tool, request.intentions, *object.workpiece);
  const AllowedPieces allowed(request.tool, options_.allowed, object.workpiece->id);
  const Scene scene{detector,          request.tool, margin,          reflex_end, request.plan,
                    *object.workpiece, intended,     request.touches, allowed};
  const Submesh submesh = submeshInReach(mesh_M, reach_M_, 0);
  second_first_.assign(request.tool.tree().size(), 0);
  ClosestApproaches& closest = request.closest != nullptr ? *request.closest : own_closest_;
  Progress progress{object, closest.to(*object.workpiece), &object.reflex};
  for (size_t i = 0; i < request.plan.sweepCount(request.path); ++i) {
    for (const SweptBody& body : segments_[i].bodies) object.volumes_M.push_back(body.volume_M);
    if (segments_[i].segment.last > reflex_sweeps) progress.triangles = &object.considered;
    checkSegment(scene, submesh, i, progress, 1);
  }
  remove(object.considered, object.reflex);
}

// Returns whether a ball around the tool, with every error that counts, stays beside the box around the mesh.
bool PathChecker::staysOutOfReach(const PredictedPathRequest& request, double margin) const {
  const Eigen::Isometry3d X_MW = request.X_WM.inverse();
  const double radius = request.tool.boundingRadius();
  Eigen::AlignedBox3d origins_M(Eigen::Vector3d(X_MW * request.X_WT.translation()));
  double error = 0.0;
  double deviation = 0.0;
  for (const PredictedPose& pose : request.path) {
    origins_M.extend(Eigen::Vector3d(X_MW * pose.X_WT.translation()));
    const double moves = std::sqrt(pose.covariance.topLeftCorner<3, 3>().trace());
    const double turns = std::sqrt(pose.covariance.bottomRightCorner<3, 3>().trace());
    error = std::max(error, moves + radius * turns);
    deviation = std::max(deviation, pose.deviation_bound);
  }
  const TriangleMesh& mesh_M = request.workpiece->mesh_M;
  const Eigen::AlignedBox3d& bounds = mesh_M.blocks().bounds();
  const double reach = (1.0 + kRounding) * (radius + margin + deviation + options_.max_deviations * error) +
                       kRounding * (mesh_M.radius() + mesh_M.origin().norm());
  const Eigen::AlignedBox3d mesh(bounds.min() + mesh_M.origin(), bounds.max() + mesh_M.origin());
  return origins_M.squaredExteriorDistance(mesh) > reach * reach;
}

void PathChecker::addFreeSweeps(const PredictedPathRequest& request, PredictedObject& object) {
  const size_t count = request.plan.sweepCount(request.path);
  object.volumes_tested = count;
  for (size_t i = 0; i < count; ++i) {
    const size_t first = i == 0 ? 0 : request.plan.sweep_ends.empty() ? i : request.plan.sweep_ends[i - 1];
    object.sweeps.push_back({first == 0 ? Duration::zero() : request.path[first - 1].ahead});
  }
}

// Sweeps the path, unless the workpiece before was in the same place.
void PathChecker::follow(const PredictedPathRequest& request, double margin) {
  const bool same = !request.frame && X_WM_ && X_WM_->matrix() == request.X_WM.matrix() && margin_ == margin;
  if (same) return;
  X_WM_.reset();
  if (request.frame != nullptr) {
    path_M_.follow(request.tool, request.X_WT, request.path, *request.frame);
  } else {
    path_M_.follow(request.tool, request.X_WT, request.path, request.X_WM);
  }
  margin_ = margin;
  reach_M_ = path_M_.reach_M(path_M_.whole(), options_.max_deviations, margin);
  swept_ = 0;
  tool_ = &request.tool.whole();
  size_t begin = 0;
  for (size_t i = 0; i < request.plan.sweepCount(request.path); ++i) {
    const size_t end = request.plan.sweep_ends.empty() ? i + 1 : request.plan.sweep_ends[i];
    sweepSegment(path_M_.between(begin, end), margin);
    begin = end;
  }
  if (request.frame == nullptr) X_WM_ = request.X_WM;
}

void PathChecker::predict(Detector& detector, const PredictionRequest& request, const SweepPlan& plan,
                          Prediction& prediction) {
  static const Workpieces kNone;
  const PredictedMotion& motion = request.motion;
  X_WM_.reset();
  own_closest_.clear();
  prediction.stamp = motion.from.stamp;
  prediction.path = motion.path;
  prediction.body_paths = motion.body_paths;
  prediction.reflex_sweeps = motion.reflex_sweeps;
  prediction.sweeps_asked = motion.path.size();
  prediction.sweeps_made = plan.sweepCount(motion.path);
  const Eigen::Isometry3d X_WB = motion.from.body(request.body).X_WB;
  const PredictedPath& path = motion.pathOf(request.body);
  const FrameMotions& frames = motion.frames ? *motion.frames : kNoFrameMotions;
  Eigen::Isometry3d X_WM = Eigen::Isometry3d::Identity();
  std::optional<FramePath> frame;
  const auto is_placed = [&](const Workpiece& workpiece) {
    frame.reset();
    const auto moving = frames.find(workpiece.frame);
    if (moving != frames.end()) {
      frame = framePath(*moving->second, motion.from.stamp, path, radiusAboutFrame(workpiece.mesh_M));
      return frame.has_value();
    }
    const auto resting = motion.from.X_WM.find(workpiece.frame);
    if (resting == motion.from.X_WM.end()) return false;
    X_WM = resting->second;
    return true;
  };
  const auto test = [&](const auto& workpiece, PredictedObject& object) {
    checkNext(detector,
              {request.tool, X_WB, path, motion.reflex_sweeps, X_WM, workpiece, plan, request.intentions,
               request.touches, frame ? &*frame : nullptr, request.closest},
              object);
  };
  testPlaced(motion.path.empty() ? kNone : request.workpieces, is_placed, prediction, test);
}

Submesh PathChecker::submeshInReach(const Submesh& around, const Eigen::AlignedBox3d& reach_M, size_t halvings) {
  while (finders_.size() <= halvings) finders_.emplace_back();
  return finders_[halvings].find(around, reach_M);
}

// Returns the index of the swept segment.
size_t PathChecker::sweepSegment(const PathSegment& segment, double margin) {
  if (swept_ == segments_.size()) segments_.emplace_back();
  SweptSegment& swept = segments_[swept_];
  swept.segment = segment;
  swept.reach_M = path_M_.reach_M(segment, options_.max_deviations, margin);
  swept.bodies.clear();
  swept.deviations.clear();
  swept.halves = {};
  path_M_.motions_M(segment, options_.sweep.max_rotation, motions_M_);
  for (const Motion& motion_M : motions_M_) {
    swept.bodies.push_back(sweptBody(*tool_, motion_M, options_.sweep.volume, margin));
  }
  return swept_++;
}

void PathChecker::sweepHalves(size_t number, double margin) {
  if (segments_[number].halves[1] != 0) return;
  const auto [first, second] = path_M_.halves(segments_[number].segment);
  segments_[number].halves = {sweepSegment(first, margin), sweepSegment(second, margin)};
}

void PathChecker::measureDeviations(const Scene& scene, SweptSegment& swept) {
  if (!swept.deviations.empty()) return;
  const Eigen::Isometry3d end_M = path_M_.end_M(swept.segment);
  const Matrix6d covariance_M = path_M_.covariance_M(swept.segment);
  for (const SweptBody& body : swept.bodies) {
    swept.deviations.push_back(planeDeviations(scene.tool.whole(), end_M, covariance_M, body.volume_M));
  }
}

PathChecker::UncertainBody PathChecker::sweepBelow(const Scene& scene, const PathSegment& segment,
                                                   const Tool::Node& below, const Motion& motion_M) const {
  const SweptBody body = sweptBody(below.shape_T, motion_M, options_.sweep.volume, scene.margin);
  return {body, planeDeviations(below.shape_T, path_M_.end_M(segment), path_M_.covariance_M(segment), body.volume_M)};
}

// Returns whether findCandidate() would find a piece of the tool, without its deviations.
bool PathChecker::hasCandidate(const Scene& scene, const Submesh& submesh, SweptSegment& swept) {
  if (submesh.empty()) return false;
  const InStage stage(Stage::kProbability);
  measureDeviations(scene, swept);
  for (size_t i = 0; i < swept.bodies.size(); ++i) {
    const Tool::Node& whole = scene.tool.tree()[0];
    if (hasCandidate(scene, submesh, swept.segment, whole, swept.bodies[i], swept.deviations[i])) return true;
  }
  return false;
}

bool PathChecker::hasCandidate(const Scene& scene, const Submesh& submesh, const PathSegment& segment,
                               const Tool::Node& node, const SweptBody& body, const PerHalfSpace& deviations) {
  if (scene.mayTouch(node)) return false;
  if (node.piece) {
    return meter_.isNear(submesh, body.volume_M, deviations, intendedFor(scene, submesh, body, node.piece));
  }
  if (!meter_.mayBeNear(submesh, body.volume_M, deviations)) return false;
  const std::array<size_t, 2> nearest_first = nearestFirst(scene, node);
  return std::any_of(nearest_first.begin(), nearest_first.end(), [&](size_t index) {
    const Tool::Node& below = scene.tool.tree()[index];
    const UncertainBody within = sweepBelow(scene, segment, below, body.motion_M);
    return hasCandidate(scene, submesh, segment, below, within.body, within.deviations);
  });
}

// Returns the nearer candidate; of two equal ones, the first.
const PathChecker::Candidate& PathChecker::nearer(const Candidate& one, const Candidate& other) {
  return other.deviations < one.deviations ? other : one;
}

PathChecker::Candidate PathChecker::noCandidate() {
  unseparated_.clear();
  not_ruled_out_.clear();
  in_contact_ = {};
  return {};
}

// Finds the piece of the tool nearest to the mesh, if it is nearer than `at_most`, and the pieces that no plane separates
// from the mesh.
PathChecker::Candidate PathChecker::findCandidate(const Scene& scene, const Submesh& submesh, SweptSegment& swept,
                                                  double at_most) {
  Candidate candidate = noCandidate();
  if (submesh.empty()) return candidate;
  const InStage stage(Stage::kProbability);
  measureDeviations(scene, swept);
  for (size_t i = 0; i < swept.bodies.size(); ++i) {
    candidate = nearer(candidate, findCandidate(scene, submesh, swept.segment, scene.tool.tree()[0], swept.bodies[i],
                                                swept.deviations[i], std::min(at_most, candidate.deviations)));
  }
  return candidate;
}

PathChecker::Candidate PathChecker::findCandidate(const Scene& scene, const Submesh& submesh,
                                                  const PathSegment& segment, const Tool::Node& node,
                                                  const SweptBody& body, const PerHalfSpace& deviations,
                                                  double at_most) {
  if (scene.mayTouch(node)) return {};
  if (node.piece) {
    const auto clearance = meter_.measure(submesh, body.volume_M, deviations,
                                          intendedFor(scene, submesh, body, node.piece), std::max(0.0, at_most));
    if (!clearance) return {};
    const Candidate candidate{clearance->deviations, node.piece};
    if (!clearance->separated) unseparated_.push_back({body, candidate});
    return scene.hasTouched(*node.piece) ? Candidate() : candidate;
  }
  if (!meter_.mayBeNear(submesh, body.volume_M, deviations)) return {};
  Candidate candidate;
  for (const size_t index : nearestFirst(scene, node)) {
    const Tool::Node& below = scene.tool.tree()[index];
    const UncertainBody within = sweepBelow(scene, segment, below, body.motion_M);
    const Candidate found = findCandidate(scene, submesh, segment, below, within.body, within.deviations,
                                          std::min(at_most, candidate.deviations));
    if (found.deviations < candidate.deviations) second_first_[indexOf(scene, node)] = index == node.below[1];
    candidate = nearer(candidate, found);
  }
  return candidate;
}

// Returns the nodes below a node, first the one that was nearer last time: what is nearest need not be told from what is
// farther.
std::array<size_t, 2> PathChecker::nearestFirst(const Scene& scene, const Tool::Node& node) const {
  const auto& [first, second] = node.below;
  if (second_first_[indexOf(scene, node)] != 0) return {second, first};
  return {first, second};
}

// Returns which triangles a piece is meant to touch; empty: none, as for boxes around pieces.
IsLeftOut PathChecker::intendedFor(const Scene& scene, const Submesh& submesh, const SweptBody& body,
                                   std::optional<size_t> piece) {
  if (!piece || scene.intended.empty()) return {};
  IntendedTriangles intended = scene.intended.trianglesOf(*piece, {body.motion_M}, scene.margin);
  if (intended.empty()) return {};
  return [intended, at_rest = MovingMesh(submesh.mesh_M())](std::uint32_t triangle) mutable {
    return intended.contains(triangle, at_rest.triangle(triangle));
  };
}

void PathChecker::detectContacts(const Scene& scene, const Submesh& submesh) {
  hulls_miss_ = true;
  for (const auto& [body, candidate] : unseparated_) {
    detect(scene.detector, submesh, body, detection_);
    leaveOut(detection_.triangles, intendedFor(scene, submesh, body, candidate.piece));
    unite(not_ruled_out_, detection_.triangles);
    if (!detection_.triangles.empty()) in_contact_ = nearer(in_contact_, candidate);
    hulls_miss_ = hulls_miss_ && hullMissesDetected(body, submesh.mesh_M());
  }
}

// Returns whether the hull of a body proves that it misses the triangles that its volume meets.
bool PathChecker::hullMissesDetected(const SweptBody& body, const TriangleMesh& mesh_M) const {
  const MovingMesh at_rest(mesh_M);
  return std::all_of(detection_.triangles.begin(), detection_.triangles.end(), [&](std::uint32_t triangle) {
    beat();
    return missedByHull(*body.shape_T, body.motion_M, at_rest.triangle(triangle), body.volume_M.margin);
  });
}

// Takes each triangle that no plane separates for met.
void PathChecker::assumeContacts(const Scene& scene, const Submesh& submesh) {
  for (const auto& [body, candidate] : unseparated_) {
    TriangleSet& triangles = detection_.triangles;
    triangles = meter_.notSeparated(submesh, body.volume_M);
    const IsLeftOut intended = intendedFor(scene, submesh, body, candidate.piece);
    leaveOut(triangles, intended);
    unite(not_ruled_out_, triangles);
    if (!intended || !triangles.empty()) in_contact_ = nearer(in_contact_, candidate);
  }
}

void PathChecker::checkSegment(const Scene& scene, const Submesh& around, size_t number, Progress& progress,
                               size_t halvings) {
  scene.plan.before_sweep();
  SweptSegment& swept = segments_[number];
  const PathSegment& segment = swept.segment;
  const Submesh submesh = submeshInReach(around, swept.reach_M, halvings);
  const Duration length = segment.to - segment.from;
  const auto halve = [&] {
    sweepHalves(number, scene.margin);
    for (const size_t half : swept.halves) checkSegment(scene, submesh, half, progress, halvings + 1);
  };

  const bool coarse = !progress.contact && length > std::max(kFinestProbable, options_.finest);
  const bool near = !coarse || hasCandidate(scene, submesh, swept);
  if (coarse && near && scene.inTimeFor(segment)) {
    progress.object.volumes_tested += swept.bodies.size();
    return halve();
  }
  const double at_most = progress.closest.upTo(segment.from);
  const Candidate candidate = near ? findCandidate(scene, submesh, swept, at_most) : noCandidate();
  const bool in_time = (!candidate.piece && unseparated_.empty()) || scene.inTimeFor(segment);
  const bool finer = !progress.contact && in_time;
  if (in_time) progress.object.volumes_tested += swept.bodies.size();
  if (in_time) {
    detectContacts(scene, submesh);
  } else {
    assumeContacts(scene, submesh);
  }
  if (!not_ruled_out_.empty() && finer && length > options_.finest) return halve();

  const auto tool_piece = not_ruled_out_.empty() ? candidate.piece : in_contact_.piece;
  const bool only_volume = !not_ruled_out_.empty() && hulls_miss_ && segment.to <= scene.reflex_end;
  const double nearest = std::min(candidate.deviations, not_ruled_out_.empty() ? kInfinity : in_contact_.deviations);
  const double deviations = only_volume ? std::max(0.0, nearest) : nearest;
  progress.object.sweeps.push_back({segment.from, !not_ruled_out_.empty(), deviations, tool_piece});
  progress.closest.add(segment.from, deviations);
  progress.contact = progress.contact || !not_ruled_out_.empty();
  unite(*progress.triangles, not_ruled_out_);
}

}  // namespace sweep_guard_core
