#include "evaluation/loop_guard.h"

#include <algorithm>

#include "detection/placed_core.h"
#include "sweep_guard/geometry/separation.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::NearTriangle;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::Twist;
using sweep_guard_core::UncoveredSurfaces;

LoopGuard::LoopGuard(const LoopGuardOptions& options)
    : options_(&options), limiter_(2 * 64 * 32) {
  const auto c = options.tool.asCylinder();
  const int n = std::max(1, int(std::ceil(c->length / options.slice - 1e-9)));
  for (int i = 0; i < n; ++i) {
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.translation().z() = -c->length * i / n;
    pieces_T_.push_back(sweep_guard_core::ConvexShape::cylinder(c->radius, c->length / n).placed(X));
    balls_T_.push_back(sweep_guard_core::enclosingBalls(pieces_T_.back()));
  }
}

void LoopGuard::measure(const Eigen::Isometry3d& X_WT, const std::array<Eigen::Vector3d, 4>& corners_W,
                        const Eigen::Vector3d& velocity_W, SteadyTime now) {
  std::vector<NearTriangle> near;
  UncoveredSurfaces beyond;
  for (size_t piece = 0; piece < pieces_T_.size(); ++piece) {
  const sweep_guard_core::PlacedCore tool{pieces_T_[piece], X_WT.linear(), X_WT.translation()};
  for (const auto& [i, j, k] : {std::array{0U, 1U, 2U}, std::array{0U, 2U, 3U}}) {
    const std::array<Eigen::Vector3d, 3> corners = {corners_W[i], corners_W[j], corners_W[k]};
    const auto apart = sweep_guard_core::separation(tool, sweep_guard_core::PointHull(corners));
    const double gap = apart.gap - options_->tool.padding();
    if (gap > options_->reach) {
      beyond.distance = std::min(beyond.distance, options_->reach);
      beyond.speed = velocity_W.norm();
    } else {
      near.push_back({piece, corners, {velocity_W, velocity_W, velocity_W}, apart.normal, gap});
    }
  }
  }
  measurements_.push_back({now, X_WT, sweep_guard_core::coverByPlanes(near, beyond)});
}

Twist LoopGuard::limit(const Twist& command_W, SteadyTime now) {
  const auto newest = [&](sweep_guard_core::Duration delay) {
    return std::find_if(measurements_.rbegin(), measurements_.rend(),
                        [&](const Measurement& measurement) { return measurement.at + delay <= now; });
  };
  while (measurements_.size() > 1 && measurements_[1].at + options_->plane_delay <= now) measurements_.pop_front();
  const auto planes = newest(options_->plane_delay);
  const auto pose = newest(options_->pose_delay);
  if (planes == measurements_.rend() || pose == measurements_.rend()) return {};
  const Eigen::Isometry3d expected_WT = in_flight_.expectedPose(pose->X_WT, now, options_->in_flight);
  dbg_pose = pose->X_WT; dbg_expected = expected_WT;
  facing_.clear();
  for (const sweep_guard_core::SeparatingPlane& plane : planes->cover.planes) {
    addFacingBalls(plane, balls_T_[plane.piece], pose->X_WT, facing_);
    addFacingBalls(plane, balls_T_[plane.piece], expected_WT, facing_);
  }
  return limiter_.limit(command_W, facing_, planes->cover.uncovered, options_->braking);
}

}  // namespace sweep_guard_evaluation
