#include "guard/path_checker.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/floating_point.h"
#include "guard/out_of_reach.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kFinestProbable = std::chrono::milliseconds(25);  // shortest sweep with a merely possible contact

// Rounded up, so that workpieces share one path.
double sharedRounding(const TriangleMesh& mesh_M) {
  constexpr double kFinest = 0x1p-20;  // [m]
  return mesh_M.rounding() <= kFinest ? kFinest : std::exp2(std::ceil(std::log2(mesh_M.rounding())));
}

void addFreeSweeps(const PredictedPathRequest& request, PredictedObject& object) {
  const size_t count = request.plan.sweepCount(request.path);
  object.volumes_tested = count;
  for (size_t i = 0; i < count; ++i) {
    const size_t first = request.plan.beginOf(i);
    object.sweeps.push_back({first == 0 ? Duration::zero() : request.path[first - 1].ahead});
  }
}

}  // namespace

PathChecker::PathChecker(const SweepOptions& options, Duration finest, double max_deviations)
    : options_(options),
      finest_(finest),
      max_deviations_(max_deviations),
      path_(options, max_deviations),
      nearest_finder_(max_deviations) {}

void PathChecker::forgetPath() {
  path_.forget();
  own_closest_.clear();
}

void PathChecker::check(Detector& detector, const PredictedPathRequest& request, PredictedObject& object) {
  forgetPath();
  begin(request, object);
  while (!done()) step(detector);
}

void PathChecker::begin(const PredictedPathRequest& request, PredictedObject& object) {
  test_.reset();
  object.clear();
  object.workpiece = request.workpiece;
  const TriangleMesh& mesh_M = object.workpiece->mesh_M;
  const double margin = options_.margin + sharedRounding(mesh_M) + mesh_M.padding();
  const bool several = request.closest != nullptr && request.frame == nullptr;
  if (several && staysOutOfReach(request, margin)) return addFreeSweeps(request, object);
  beginTest(request, margin, object);
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
  const double reach = radius + margin + deviation + max_deviations_ * error;
  return staysBeside(request.workpiece->mesh_M, origins_M, reach);
}

void PathChecker::beginTest(const PredictedPathRequest& request, double margin, PredictedObject& object) {
  path_.follow(request, margin);
  halves_.clear();
  const Workpiece& workpiece = *object.workpiece;
  const Submesh around = submeshInReach(workpiece.mesh_M, path_.reach_M(), 0);
  const bool bounded = !around.empty() && (request.closest != nullptr || request.tool.pieces().size() > 1);
  if (bounded) boxes_.around(around);
  ClosestApproaches& closest = request.closest != nullptr ? *request.closest : own_closest_;
  const size_t reflex_sweeps = request.reflex_sweeps;
  test_.emplace(
      Test{{request.tool, workpiece, ContactPolicy(request.tool, workpiece, request.allowed, request.intentions),
            request.touches, options_, margin},
           request.plan,
           request.plan.sweepCount(request.path),
           reflex_sweeps,
           reflex_sweeps == 0 ? Duration::zero() : request.path[reflex_sweeps - 1].ahead,
           around,
           bounded,
           object,
           closest.to(workpiece),
           &object.reflex});
}

Submesh PathChecker::submeshInReach(const Submesh& around, const Eigen::AlignedBox3d& reach_M, size_t halvings) {
  while (finders_.size() <= halvings) finders_.emplace_back();
  return finders_[halvings].find(around, reach_M);
}

void PathChecker::step(Detector& detector) {
  assert(!done());
  testSegment(detector, nextSegment());
  if (!halves_.empty() || test_->next < test_->count) return;
  remove(test_->object.considered, test_->object.reflex);
  test_.reset();
}

PathChecker::Waiting PathChecker::nextSegment() {
  if (!halves_.empty()) {
    const Waiting half = halves_.back();
    halves_.pop_back();
    return half;
  }
  const size_t number = test_->next++;
  const SweptSegment& swept = path_[number];
  for (const SweptBody& body : swept.bodies) test_->object.volumes_M.push_back(body.volume_M);
  if (swept.segment.last > test_->reflex_sweeps) test_->triangles = &test_->object.considered;
  return {number, test_->around, 1};
}

void PathChecker::testSegment(Detector& detector, const Waiting& waiting) {
  Test& test = *test_;
  const WorkpieceOnPath& on_path = test.on_path;
  const PathSegment segment = path_[waiting.number].segment;
  const size_t volumes = path_[waiting.number].bodies.size();
  const double at_most = test.closest.upTo(segment.from);
  const auto step = test.bounded ? path_.uncertainStep(segment) : std::nullopt;
  const PieceBounds bounds = step ? PieceBounds(on_path.tool, *step, boxes_, bounds_) : PieceBounds();
  if (step && !bounds.anyWithin(nearest_finder_.limit(at_most), on_path.contact)) {
    test.object.volumes_tested += volumes;
    test.object.sweeps.push_back({segment.from});
    return;
  }
  const Submesh submesh = submeshInReach(waiting.around, path_[waiting.number].reach_M, waiting.halvings);
  const SweptSegment& swept = submesh.empty() ? path_[waiting.number] : path_.measure(waiting.number);
  const Duration length = segment.to - segment.from;
  const bool coarse = !test.contact && length > std::max(kFinestProbable, finest_);
  const bool near = !coarse || nearest_finder_.any(on_path, submesh, swept, bounds);
  if (coarse && near && test.inTimeFor(segment)) {
    test.object.volumes_tested += volumes;
    return halve(waiting, submesh);
  }
  PieceApproach nearest;
  unseparated_.clear();
  if (near) nearest = nearest_finder_.find(on_path, submesh, swept, bounds, at_most, unseparated_);
  const bool none = !nearest.piece && unseparated_.empty();
  const bool in_time = none || test.inTimeFor(segment);
  if (in_time) {
    test.object.volumes_tested += volumes;
    contact_finder_.detect(detector, on_path, submesh, unseparated_, test.object, segment.to <= test.reflex_end,
                           contacts_);
  } else {
    contact_finder_.assume(on_path, submesh, unseparated_, contacts_);
  }
  if (contacts_.meets && !test.contact && in_time && length > finest_) return halve(waiting, submesh);
  report(segment, nearest, contacts_);
}

void PathChecker::halve(const Waiting& waiting, const Submesh& submesh) {
  const auto [first, second] = path_.halve(waiting.number);
  for (const size_t half : {second, first}) halves_.push_back({half, submesh, waiting.halvings + 1});
}

void PathChecker::report(const PathSegment& segment, const PieceApproach& nearest, const SegmentContacts& contacts) {
  Test& test = *test_;
  const bool only_volume = contacts.meets && contacts.only_volume;
  const double least = std::min(nearest.deviations, contacts.nearest.deviations);
  const double deviations = only_volume ? std::max(0.0, least) : least;
  const auto piece = contacts.meets ? contacts.nearest.piece : nearest.piece;
  test.object.sweeps.push_back({segment.from, contacts.meets, deviations, piece});
  test.closest.add(segment.from, deviations);
  test.contact = test.contact || contacts.meets;
  unite(*test.triangles, contacts.newly_met);
}

}  // namespace sweep_guard_core
