#include "guard/path_checker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/floating_point.h"
#include "common/heartbeat.h"
#include "common/stage_clock.h"
#include "guard/moving_mesh.h"
#include "guard/out_of_reach.h"
#include "guard/placed_workpieces.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kFinestProbable = std::chrono::milliseconds(25);  // shortest sweep with a merely possible contact

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
  bool bounded;  // pieces that come no nearer are left out before their volumes are computed
  const IntendedContact& intended;
  const IntendedTouches& touches;
  const AllowedPieces& allowed;

  bool mayTouch(size_t piece) const { return allowed.contains(piece); }
  bool inTimeFor(const PathSegment& segment) const {
    return segment.to <= reflex_end || !plan.out_of_time || !plan.out_of_time();
  }
  bool hasTouched(size_t piece) const {
    return !intended.empty() && touches.contains(workpiece.id, tool.pieces()[piece].link);
  }
};

struct PathChecker::Progress {
  PredictedObject& object;
  ClosestApproach& closest;
  TriangleSet* triangles;  // of the interval under test
  bool contact = false;    // found in an earlier segment

  bool hasReported(std::uint32_t triangle) const {
    const auto among = [&](const TriangleSet& set) { return std::binary_search(set.begin(), set.end(), triangle); };
    return among(*triangles) || among(object.reflex);
  }
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
  const Submesh submesh = submeshInReach(mesh_M, reach_M_, 0);
  const bool bounded = !submesh.empty() && (request.closest != nullptr || request.tool.pieces().size() > 1);
  const Scene scene{detector,          request.tool, margin,   reflex_end,      request.plan,
                    *object.workpiece, bounded,      intended, request.touches, allowed};
  if (bounded) boxes_.around(submesh);
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
  const double reach = radius + margin + deviation + options_.max_deviations * error;
  return staysBeside(request.workpiece->mesh_M, origins_M, reach);
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
  swept.end_M = path_M_.end_M(swept.segment);
  const auto& [X_MT, covariance_M] = swept.end_M;
  for (const SweptBody& body : swept.bodies) {
    swept.deviations.push_back(planeDeviations(scene.tool.whole(), X_MT, covariance_M, body.volume_M));
  }
}

PathChecker::UncertainBody PathChecker::sweepPiece(const Scene& scene, const UncertainMotion& motion,
                                                   const ConvexShape& piece) const {
  const SweptBody body = sweptBody(piece, motion.motion_M, options_.sweep.volume, scene.margin);
  return {body, planeDeviations(piece, motion.end_M.X_MT, motion.end_M.covariance_M, body.volume_M)};
}

// Returns whether findNearestPiece() would find a piece of the tool, without its deviations.
bool PathChecker::hasCandidate(const Scene& scene, const Submesh& submesh, SweptSegment& swept) {
  if (submesh.empty()) return false;
  const InStage stage(Stage::kProbability);
  measureDeviations(scene, swept);
  const std::optional<size_t>& only_piece = scene.tool.tree()[0].piece;
  for (size_t i = 0; i < swept.bodies.size(); ++i) {
    const SweptBody& body = swept.bodies[i];
    const PerHalfSpace& deviations = swept.deviations[i];
    const bool near = only_piece
                          ? !scene.mayTouch(*only_piece) && meter_.isNear(submesh, body.volume_M, deviations,
                                                                          intendedFor(scene, submesh, body, only_piece))
                          : meter_.mayBeNear(submesh, body.volume_M, deviations) &&
                                hasCandidateBelow(scene, submesh, {body.motion_M, swept.end_M}, 0);
    if (near) return true;
  }
  return false;
}

bool PathChecker::hasCandidateBelow(const Scene& scene, const Submesh& submesh, const UncertainMotion& motion,
                                    size_t node) {
  const Tool::Node& below = scene.tool.tree()[node];
  if (isLeftOut(scene, submesh, motion, node, kInfinity)) return false;
  if (below.piece) {
    const UncertainBody piece = sweepPiece(scene, motion, below.shape_T);
    return meter_.isNear(submesh, piece.body.volume_M, piece.deviations,
                         intendedFor(scene, submesh, piece.body, below.piece));
  }
  const std::array<size_t, 2> nearest_first = nearestFirst(scene, below);
  return std::any_of(nearest_first.begin(), nearest_first.end(),
                     [&](size_t index) { return hasCandidateBelow(scene, submesh, motion, index); });
}

// Returns the nearer approach; of two equal ones, the first.
const PathChecker::PieceApproach& PathChecker::nearer(const PieceApproach& one, const PieceApproach& other) {
  return other.deviations < one.deviations ? other : one;
}

PathChecker::PieceApproach PathChecker::noApproach() {
  unseparated_.clear();
  newly_met_.clear();
  meets_ = false;
  in_contact_ = {};
  return {};
}

// Finds the piece of the tool nearest to the mesh, if it is nearer than `at_most`, and the pieces that no plane separates
// from the mesh.
PathChecker::PieceApproach PathChecker::findNearestPiece(const Scene& scene, const Submesh& submesh,
                                                         SweptSegment& swept, double at_most) {
  PieceApproach approach = noApproach();
  if (submesh.empty()) return approach;
  const InStage stage(Stage::kProbability);
  measureDeviations(scene, swept);
  const std::optional<size_t>& only_piece = scene.tool.tree()[0].piece;
  for (size_t i = 0; i < swept.bodies.size(); ++i) {
    const SweptBody& body = swept.bodies[i];
    const PerHalfSpace& deviations = swept.deviations[i];
    const double nearest = std::min(at_most, approach.deviations);
    if (only_piece) {
      approach = nearer(approach, measure(scene, submesh, {body, deviations, *only_piece}, nearest));
    } else if (meter_.mayBeNear(submesh, body.volume_M, deviations)) {
      approach =
          nearer(approach, findNearestPieceBelow(scene, submesh, {body.motion_M, swept.end_M}, /*node=*/0, nearest));
    }
  }
  return approach;
}

PathChecker::PieceApproach PathChecker::findNearestPieceBelow(const Scene& scene, const Submesh& submesh,
                                                              const UncertainMotion& motion, size_t node,
                                                              double at_most) {
  const Tool::Node& below = scene.tool.tree()[node];
  if (isLeftOut(scene, submesh, motion, node, at_most)) return {};
  if (below.piece) {
    const UncertainBody piece = sweepPiece(scene, motion, below.shape_T);
    return measure(scene, submesh, {piece.body, piece.deviations, *below.piece}, at_most);
  }
  PieceApproach approach;
  for (const size_t index : nearestFirst(scene, below)) {
    const double nearest = std::min(at_most, approach.deviations);
    approach = nearer(approach, findNearestPieceBelow(scene, submesh, motion, index, nearest));
  }
  return approach;
}

// Returns whether no piece below a node counts, or comes nearer than `at_most`. The planes that cut the box of a piece take more
// time than the box, and most boxes suffice. Without bounds, the boxes around pieces have to.
bool PathChecker::isLeftOut(const Scene& scene, const Submesh& submesh, const UncertainMotion& motion, size_t node,
                            double at_most) {
  const Tool::Node& below = scene.tool.tree()[node];
  if (below.piece && scene.mayTouch(*below.piece)) return true;
  if (comesNoNearer(scene, node, at_most)) return true;
  const bool box_helps = below.piece ? options_.sweep.volume != VolumeKind::kObb : !step_;
  if (!box_helps) return false;
  const SweptVolume box_M = sweptVolume(below.shape_T, motion.motion_M, VolumeKind::kObb, scene.margin);
  const PerHalfSpace deviations = planeDeviations(below.shape_T, motion.end_M.X_MT, motion.end_M.covariance_M, box_M);
  return meter_.isSeparated(submesh, box_M, deviations, below.piece ? limit(at_most) : limit(kInfinity));
}

PathChecker::PieceApproach PathChecker::measure(const Scene& scene, const Submesh& submesh, const SweptPiece& swept,
                                                double at_most) {
  const auto& [body, deviations, piece] = swept;
  if (scene.mayTouch(piece)) return {};
  const auto clearance = meter_.measure(submesh, body.volume_M, deviations, intendedFor(scene, submesh, body, piece),
                                        std::max(0.0, at_most));
  if (!clearance) return {};
  const PieceApproach approach{clearance->deviations, piece};
  if (!clearance->separated) unseparated_.push_back({body, approach});
  return scene.hasTouched(piece) ? PieceApproach() : approach;
}

void PathChecker::boundPieces(const Scene& scene, const PathSegment& segment) {
  step_.reset();
  if (!scene.bounded || segment.last - segment.first > 1) return;
  step_.emplace(path_M_.uncertainStep(segment, scene.margin));
  least_.assign(scene.tool.tree().size(), std::nullopt);
}

// Returns a bound on the clearances of the pieces below a node in the segment under test, without their volumes.
double PathChecker::leastDeviations(const Scene& scene, size_t node) {
  if (!step_) return -kInfinity;
  std::optional<double>& least = least_[node];
  if (!least) {
    const UncertainBall ball = step_->ballAround(scene.tool.tree()[node].bounds_T);
    least = ball.deviationsWithin(boxes_.distanceFrom(ball.center_M));
  }
  return *least;
}

double PathChecker::limit(double at_most) const { return std::max(0.0, std::min(at_most, options_.max_deviations)); }

bool PathChecker::comesNoNearer(const Scene& scene, size_t node, double at_most) {
  return leastDeviations(scene, node) > limit(at_most);
}

bool PathChecker::noPieceComesNearer(const Scene& scene, size_t node, double at_most) {
  if (comesNoNearer(scene, node, at_most)) return true;
  const Tool::Node& below = scene.tool.tree()[node];
  if (below.piece) return scene.mayTouch(*below.piece);
  return std::all_of(below.below.begin(), below.below.end(),
                     [&](size_t index) { return noPieceComesNearer(scene, index, at_most); });
}

// Returns the nodes below a node, first the one that may come nearer: what is nearest need not be told from what is farther.
std::array<size_t, 2> PathChecker::nearestFirst(const Scene& scene, const Tool::Node& node) {
  const auto& [first, second] = node.below;
  if (leastDeviations(scene, second) < leastDeviations(scene, first)) return {second, first};
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

void PathChecker::detectContacts(const Scene& scene, const Submesh& submesh, const Progress& progress, bool reflex) {
  hulls_miss_ = reflex;
  for (const auto& [body, approach] : unseparated_) {
    beat();
    detection_ = scene.detector.detect(submesh, body.volume_M);
    if (keepNewlyMet(body, intendedFor(scene, submesh, body, approach.piece), submesh.mesh_M(), progress))
      addContact(approach);
    unite(newly_met_, detection_.triangles);
  }
}

// Keeps of the detected triangles those that the body meets and that are not reported yet. Returns whether it meets any: of
// those that are reported, one is enough.
bool PathChecker::keepNewlyMet(const SweptBody& body, const IsLeftOut& intended, const TriangleMesh& mesh_M,
                               const Progress& progress) {
  const MovingMesh at_rest(mesh_M);
  const auto isMissed = [&](std::uint32_t triangle, double margin) {
    return missedByHull(*body.shape_T, body.motion_M, at_rest.triangle(triangle), margin);
  };
  const double margin = body.volume_M.margin;
  bool meets = false;
  const auto isNewlyMet = [&](std::uint32_t triangle) {
    const bool reported = progress.hasReported(triangle);
    if (reported && meets && !hulls_miss_) return false;
    beat();
    if (intended && intended(triangle)) return false;
    if (body.kind == VolumeKind::kHull && isMissed(triangle, margin + detection_.inflation)) return false;
    meets = true;
    hulls_miss_ = hulls_miss_ && isMissed(triangle, margin);
    return !reported;
  };
  TriangleSet& triangles = detection_.triangles;
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), std::not_fn(isNewlyMet)), triangles.end());
  return meets;
}

void PathChecker::addContact(const PieceApproach& approach) {
  meets_ = true;
  in_contact_ = nearer(in_contact_, approach);
}

// Takes each triangle that no plane separates for met. Most pieces name the same ones: they are sorted at the end.
void PathChecker::assumeContacts(const Scene& scene, const Submesh& submesh) {
  assumed_.assign(submesh.mesh_M().triangles().size(), 0);
  for (const auto& [body, approach] : unseparated_) {
    const IsLeftOut intended = intendedFor(scene, submesh, body, approach.piece);
    bool meets = false;
    for (const std::uint32_t triangle : meter_.notSeparated(submesh, body.volume_M)) {
      if (intended && intended(triangle)) continue;
      meets = true;
      if (std::exchange(assumed_[triangle], 1) == 0) newly_met_.push_back(triangle);
    }
    if (meets) addContact(approach);
  }
  std::sort(newly_met_.begin(), newly_met_.end());
}

void PathChecker::checkSegment(const Scene& scene, const Submesh& around, size_t number, Progress& progress,
                               size_t halvings) {
  scene.plan.before_sweep();
  SweptSegment& swept = segments_[number];
  const PathSegment& segment = swept.segment;
  const double at_most = progress.closest.upTo(segment.from);
  boundPieces(scene, segment);
  if (step_ && noPieceComesNearer(scene, /*node=*/0, at_most)) {
    progress.object.volumes_tested += swept.bodies.size();
    progress.object.sweeps.push_back({segment.from});
    return;
  }
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
  const PieceApproach approach = near ? findNearestPiece(scene, submesh, swept, at_most) : noApproach();
  const bool in_time = (!approach.piece && unseparated_.empty()) || scene.inTimeFor(segment);
  const bool finer = !progress.contact && in_time;
  if (in_time) progress.object.volumes_tested += swept.bodies.size();
  if (in_time) {
    detectContacts(scene, submesh, progress, segment.to <= scene.reflex_end);
  } else {
    assumeContacts(scene, submesh);
  }
  if (meets_ && finer && length > options_.finest) return halve();

  const bool only_volume = meets_ && hulls_miss_ && segment.to <= scene.reflex_end;
  const double nearest = std::min(approach.deviations, meets_ ? in_contact_.deviations : kInfinity);
  const double deviations = only_volume ? std::max(0.0, nearest) : nearest;
  progress.object.sweeps.push_back({segment.from, meets_, deviations, meets_ ? in_contact_.piece : approach.piece});
  progress.closest.add(segment.from, deviations);
  progress.contact = progress.contact || meets_;
  unite(*progress.triangles, newly_met_);
}

}  // namespace sweep_guard_core
