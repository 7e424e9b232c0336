#include "sweep_guard/guard/expected_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace sweep_guard {
namespace {

constexpr double kMostTurn = 1.5;  // [rad], of steps that are joined

Matrix6d turned(const Matrix6d& covariance_W, const Eigen::Matrix3d& R_MW) {
  Matrix6d R = Matrix6d::Zero();
  R.topLeftCorner<3, 3>() = R_MW;
  R.bottomRightCorner<3, 3>() = R_MW;
  return R * covariance_W * R.transpose();
}

double share(Duration part, Duration whole) { return toSeconds(part) / toSeconds(whole); }

// Along the axes of M, of a point at r from the tool's origin: it moves by dx + dtheta x r.
Eigen::Vector3d pointDeviations(const Eigen::Vector3d& r_M, const Matrix6d& covariance_M) {
  Eigen::Matrix<double, 3, 6> J;
  J << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) J.row(axis).tail<3>() = r_M.cross(Eigen::Vector3d::Unit(axis));
  return (J * covariance_M * J.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
}

// Holds every tool point at a pose that is off by up to so many standard deviations. How far a point may be off along
// an axis is convex in the point: the corners of a box around the tool bound it.
Eigen::AlignedBox3d boxAround(const Tool& tool, const Eigen::Isometry3d& X_MT, const Matrix6d& covariance_M,
                              double most) {
  Eigen::AlignedBox3d box_M;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3d::CornerType>(i);
    const Eigen::Vector3d r_M = X_MT.linear() * tool.bounds_T().corner(corner);
    const Eigen::Vector3d p_M = X_MT.translation() + r_M;
    const Eigen::Vector3d off = most * pointDeviations(r_M, covariance_M);
    box_M.extend(Eigen::AlignedBox3d(p_M - off, p_M + off));
  }
  return box_M;
}

}  // namespace

ExpectedMotion::ExpectedMotion(const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
                               const Eigen::Isometry3d& X_WM)
    : tool_(tool) {
  assert(!path.empty());
  const Eigen::Isometry3d X_MW = X_WM.inverse();
  poses_.push_back({Duration::zero(), X_MW * X_WT, Matrix6d::Zero()});
  for (const ExpectedPose& pose : path) {
    poses_.push_back({pose.ahead, X_MW * pose.X_WT, turned(pose.covariance, X_MW.linear())});
  }
}

std::pair<Stretch, Stretch> ExpectedMotion::halves(const Stretch& stretch) const {
  const auto& [from, to, first, last] = stretch;
  if (last - first > 1) return {between(first, (first + last) / 2), between((first + last) / 2, last)};
  const Duration middle = from + (to - from) / 2;
  return {{from, middle, first, last}, {middle, to, first, last}};
}

ExpectedMotion::Pose ExpectedMotion::at(Duration time, size_t first) const {
  const Pose& before = poses_[first];
  const Pose& after = poses_[first + 1];
  if (time == before.time) return before;
  if (time == after.time) return after;
  const double along = share(time - before.time, after.time - before.time);
  return {time, Motion{before.X_MT, after.X_MT}.at(along),
          (1.0 - along) * before.covariance_M + along * after.covariance_M};
}

std::vector<Motion> ExpectedMotion::motions_M(const Stretch& stretch, double max_rotation) const {
  Motion motion_M{at(stretch.from, stretch.first).X_MT, end_M(stretch)};
  if (stretch.last - stretch.first == 1) return split(motion_M, max_rotation);
  motion_M.bulge = bulge(motion_M, stretch);
  return {motion_M};
}

// At a pose between, a tool point is off by no more than the pose's shift and its turn times the tool's extent. From
// one such pose to the next both the motion and its chord are straight but for their arcs.
double ExpectedMotion::bulge(const Motion& chord_M, const Stretch& stretch) const {
  const double extent = tool_.extent();
  const double turn = chord_M.angle();
  double off = 0.0;
  double arc = 0.0;
  for (size_t i = stretch.first + 1; i <= stretch.last; ++i) {
    const Motion step{poses_[i - 1].X_MT, poses_[i].X_MT};
    const double along = share(poses_[i].time - stretch.from, stretch.to - stretch.from);
    const double step_share = share(poses_[i].time - poses_[i - 1].time, stretch.to - stretch.from);
    const Motion error{chord_M.at(along), poses_[i].X_MT};
    const double shift = (error.X_MT_end.translation() - error.X_MT_start.translation()).norm();
    off = std::max(off, shift + extent * error.angle());
    arc = std::max(arc, chordError(extent, step.angle()) + chordError(extent, step_share * turn));
  }
  return off + arc + chordError(extent, turn);
}

Eigen::AlignedBox3d ExpectedMotion::reach_M(const Stretch& stretch, double most, double margin) const {
  std::vector<Pose> poses = {at(stretch.from, stretch.first)};
  for (size_t i = stretch.first + 1; i < stretch.last; ++i) poses.push_back(poses_[i]);
  poses.push_back(at(stretch.to, stretch.last - 1));

  Eigen::AlignedBox3d box_M;
  double arc = 0.0;
  for (size_t i = 0; i < poses.size(); ++i) {
    box_M.extend(boxAround(tool_, poses[i].X_MT, poses[i].covariance_M, most));
    if (i > 0) arc = std::max(arc, chordError(tool_.extent(), Motion{poses[i - 1].X_MT, poses[i].X_MT}.angle()));
  }
  return {box_M.min().array() - (arc + margin), box_M.max().array() + (arc + margin)};
}

std::vector<size_t> sweepEnds(const Eigen::Isometry3d& X_WT, const PredictedPath& path, size_t reflex_sweeps,
                              size_t considered_sweeps) {
  assert(considered_sweeps >= 1 && reflex_sweeps <= path.size());
  std::vector<size_t> ends(reflex_sweeps);
  std::iota(ends.begin(), ends.end(), 1);
  const size_t steps = path.size() - reflex_sweeps;
  const auto due = [&](size_t end) { return (end - reflex_sweeps) * considered_sweeps / steps; };
  size_t begin = reflex_sweeps;
  double turn = 0.0;
  for (size_t end = begin + 1; end <= path.size(); ++end) {
    const double step = Motion{end == 1 ? X_WT : path[end - 2].X_WT, path[end - 1].X_WT}.angle();
    const bool too_far = turn + step > kMostTurn && begin < end - 1;
    if (too_far) ends.push_back(end - 1);
    if (due(end) > due(end - 1)) ends.push_back(end);
    turn = too_far ? step : turn + step;
    if (due(end) > due(end - 1)) turn = 0.0;
    begin = ends.empty() ? 0 : ends.back();
  }
  return ends;
}

}  // namespace sweep_guard
