#include "guard/path_in_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace sweep_guard_core {
namespace {

constexpr double kMaxTurn = 1.5;  // [rad], of joined steps together

Matrix6d turnedCovariance(const Matrix6d& covariance_W, const Eigen::Matrix3d& R_MW) {
  Matrix6d R = Matrix6d::Zero();
  R.topLeftCorner<3, 3>() = R_MW;
  R.bottomRightCorner<3, 3>() = R_MW;
  return R * covariance_W * R.transpose();
}

// The covariance of the error that a tool at `r` from the origin of a frame seems to have where the pose of the frame errs: a
// point there moves by dx + dtheta x r.
Matrix6d movedTo(const Eigen::Vector3d& r, const Matrix6d& covariance) {
  Matrix6d J = Matrix6d::Identity();
  J.topRightCorner<3, 3>() << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  return J * covariance * J.transpose();
}

double fraction(Duration elapsed, Duration whole) { return toSeconds(elapsed) / toSeconds(whole); }

// Variances along the axes of M of a point at r from the tool's origin: the point moves by dx + dtheta x r, and along an
// axis e by e·dx + (r x e)·dtheta. One component of r x e is 0.
Eigen::Array3d pointVariances(const Eigen::Vector3d& r_M, const Matrix6d& covariance_M) {
  Eigen::Array3d variances;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    const double to_next = r_M[last];
    const double to_last = -r_M[next];
    const auto C = [&](int row, int column) { return covariance_M(row, column); };
    variances[axis] = C(axis, axis) + 2.0 * (C(axis, 3 + next) * to_next + C(axis, 3 + last) * to_last) +
                      C(3 + next, 3 + next) * to_next * to_next + C(3 + last, 3 + last) * to_last * to_last +
                      2.0 * C(3 + next, 3 + last) * to_next * to_last;
  }
  return variances;
}

// Holds every tool point at a pose that errs by up to `max_deviations` standard deviations of either covariance. A
// point's standard deviation along an axis is convex in the point, so the corners of a box around the tool bound it.
Eigen::AlignedBox3d boxAround(const Eigen::AlignedBox3d& tool_T, const Eigen::Isometry3d& X_MT,
                              const Matrix6d& one_covariance_M, const Matrix6d& other_covariance_M,
                              double max_deviations) {
  Eigen::AlignedBox3d box_M;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
    const Eigen::Vector3d r_M = X_MT.linear() * tool_T.corner(corner);
    const Eigen::Vector3d p_M = X_MT.translation() + r_M;
    const Eigen::Array3d variances =
        pointVariances(r_M, one_covariance_M).max(pointVariances(r_M, other_covariance_M)).max(0.0);
    const Eigen::Vector3d error = max_deviations * variances.sqrt().matrix();
    box_M.extend(Eigen::AlignedBox3d(p_M - error, p_M + error));
  }
  return box_M;
}

}  // namespace

void PathInMesh::begin(const Tool& tool) {
  tool_T_ = tool.bounds_T();
  tool_radius_ = tool.boundingRadius();
  path_M_.clear();
  covariances_M_.clear();
  deviations_.assign(1, 0.0);
  steps_W_.clear();
}

void PathInMesh::follow(const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
                        const Eigen::Isometry3d& X_WM) {
  assert(!path.empty());
  begin(tool);
  const Eigen::Isometry3d X_MW = X_WM.inverse();
  path_M_.push_back({Duration::zero(), X_MW * X_WT, 0.0});
  covariances_M_.emplace_back(Matrix6d::Zero());
  for (const PredictedPose& pose : path) {
    const Motion step_M{path_M_.back().X_MT, X_MW * pose.X_WT};
    path_M_.push_back({pose.ahead, step_M.X_MT_end, chordError(tool_radius_, step_M.angle()) + pose.deviation_bound});
    covariances_M_.push_back(turnedCovariance(pose.covariance, X_MW.linear()));
    deviations_.push_back(pose.deviation_bound);
  }
}

void PathInMesh::follow(const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
                        const std::vector<PredictedFrame>& frame) {
  assert(!path.empty() && frame.size() == path.size() + 1);
  begin(tool);
  const Eigen::Isometry3d* from_WT = &X_WT;
  const auto add = [&](Duration ahead, const Matrix6d& covariance_W, const PredictedFrame& moved, double deviation) {
    path_M_.push_back({ahead, moved.X_WM.inverse() * *from_WT, deviation});
    const Matrix6d both_W = covariance_W + movedTo(from_WT->translation() - moved.X_WM.translation(), moved.covariance);
    covariances_M_.push_back(turnedCovariance(both_W, moved.X_WM.linear().transpose()));
  };
  add(Duration::zero(), Matrix6d::Zero(), frame[0], 0.0);
  for (size_t i = 0; i < path.size(); ++i) {
    const PredictedFrame& moved = frame[i + 1];
    deviations_.push_back(path[i].deviation_bound + moved.deviation_bound);
    steps_W_.push_back({{*from_WT, path[i].X_WT, deviations_.back()}, {frame[i].X_WM, moved.X_WM}});
    from_WT = &path[i].X_WT;
    add(path[i].ahead, path[i].covariance, moved, chordError(steps_W_.back(), tool_radius_) + deviations_.back());
  }
}

std::pair<PathSegment, PathSegment> PathInMesh::halves(const PathSegment& segment) const {
  const auto& [from, to, first, last] = segment;
  if (last - first > 1) return {between(first, (first + last) / 2), between((first + last) / 2, last)};
  const Duration middle = from + (to - from) / 2;
  return {{from, middle, first, last}, {middle, to, first, last}};
}

UncertainPose PathInMesh::at(Duration time, size_t first) const {
  const PathPoint& before = path_M_[first];
  const PathPoint& after = path_M_[first + 1];
  if (time == before.time) return {before.X_MT, covariances_M_[first]};
  if (time == after.time) return {after.X_MT, covariances_M_[first + 1]};
  const double share = shareOf(time, first);
  const Eigen::Isometry3d X_MT = steps_W_.empty()
                                     ? Motion{before.X_MT, after.X_MT}.at(share)
                                     : steps_W_[first].frame_W.at(share).inverse() * steps_W_[first].tool_W.at(share);
  return {X_MT, (1.0 - share) * covariances_M_[first] + share * covariances_M_[first + 1]};
}

double PathInMesh::shareOf(Duration time, size_t first) const {
  return fraction(time - path_M_[first].time, path_M_[first + 1].time - path_M_[first].time);
}

// Of a segment within one step.
RelativeMotion PathInMesh::part(const PathSegment& segment) const {
  const auto& [tool_W, frame_W] = steps_W_[segment.first];
  const double from = shareOf(segment.from, segment.first);
  const double to = shareOf(segment.to, segment.first);
  return {{tool_W.at(from), tool_W.at(to), tool_W.deviation_bound}, {frame_W.at(from), frame_W.at(to)}};
}

void PathInMesh::motions_M(const PathSegment& segment, double max_rotation, std::vector<Motion>& motions_M) const {
  if (segment.last - segment.first > 1) {
    motions_M.assign(1, mergedMotion(path_M_, segment.first, segment.last, tool_radius_));
    return;
  }
  if (!steps_W_.empty()) {
    motions_M = split(part(segment), max_rotation, tool_radius_, std::move(motions_M));
    return;
  }
  const Motion step_M{at(segment.from, segment.first).X_MT, end_M(segment).X_MT, deviations_[segment.last]};
  motions_M = step_M.deviation_bound == 0.0
                  ? split(step_M, max_rotation, std::move(motions_M))
                  : split(RelativeMotion{step_M, {}}, max_rotation, tool_radius_, std::move(motions_M));
}

Eigen::AlignedBox3d PathInMesh::reach_M(const PathSegment& segment, double deviations, double margin) const {
  UncertainPose pose = at(segment.from, segment.first);
  Eigen::AlignedBox3d box_M;
  double arc = 0.0;
  const auto extendTo = [&](const UncertainPose& next, double deviation) {
    // Every covariance between the poses lies between theirs, so no deviation exceeds the larger of both.
    for (const Eigen::Isometry3d& X_MT : {pose.X_MT, next.X_MT}) {
      box_M.extend(boxAround(tool_T_, X_MT, pose.covariance_M, next.covariance_M, deviations));
    }
    arc = std::max(arc, chordError(tool_radius_, Motion{pose.X_MT, next.X_MT}.angle()) + deviation);
    pose = next;
  };
  for (size_t i = segment.first + 1; i < segment.last; ++i)
    extendTo({path_M_[i].X_MT, covariances_M_[i]}, deviations_[i]);
  extendTo(at(segment.to, segment.last - 1), deviations_[segment.last]);
  if (!steps_W_.empty()) {
    for (size_t i = segment.first + 1; i <= segment.last; ++i) arc = std::max(arc, path_M_[i].deviation_bound);
  }
  return {box_M.min().array() - (arc + margin), box_M.max().array() + (arc + margin)};
}

// Its poses leave the chord by their arcs. So do volumes around points between them, which may leave their motion, too.
UncertainStep PathInMesh::uncertainStep(const PathSegment& segment, double margin) const {
  assert(segment.last - segment.first == 1);
  const double arcs = path_M_[segment.last].deviation_bound - deviations_[segment.last];
  const double margin_and_arcs = margin + 2.0 * arcs + deviations_[segment.last];
  return {at(segment.from, segment.first), at(segment.to, segment.first), margin_and_arcs};
}

void findSweepEnds(const Eigen::Isometry3d& X_WT, const PredictedPath& path, size_t reflex_sweeps,
                   size_t considered_sweeps, std::vector<size_t>& ends) {
  assert(considered_sweeps >= 1 && reflex_sweeps <= path.size());
  ends.resize(reflex_sweeps);
  std::iota(ends.begin(), ends.end(), 1);
  const size_t steps = path.size() - reflex_sweeps;
  const auto due = [&, first = reflex_sweeps](size_t end) { return (end - first) * considered_sweeps / steps; };
  size_t begin = reflex_sweeps;
  double turn = 0.0;
  for (size_t end = begin + 1; end <= path.size(); ++end) {
    const double step = Motion{end == 1 ? X_WT : path[end - 2].X_WT, path[end - 1].X_WT}.angle();
    const bool too_far = turn + step > kMaxTurn && begin < end - 1;
    if (too_far) ends.push_back(end - 1);
    if (due(end) > due(end - 1)) ends.push_back(end);
    turn = too_far ? step : turn + step;
    if (due(end) > due(end - 1)) turn = 0.0;
    begin = ends.empty() ? 0 : ends.back();
  }
}

}  // namespace sweep_guard_core
