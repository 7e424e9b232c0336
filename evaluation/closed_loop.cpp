#include "evaluation/closed_loop.h"

#include <algorithm>

namespace sweep_guard_evaluation {

using sweep_guard_core::Separation;
using sweep_guard_core::Twist;

namespace {

// [m] So near, the tool is at the standoff: it approaches it only asymptotically, and a plane lies up to a twentieth of its
// gap before its surface.
constexpr double kAtStandoff = 1.5e-4;

}  // namespace

Eigen::Isometry3d SurfaceVelocity::poseAt(sweep_guard_core::Time time) const {
  Eigen::Isometry3d X_WM = Eigen::Isometry3d::Identity();
  X_WM.translation() = sweep_guard_core::toSeconds(time - there) * v_W;
  return X_WM;
}

ClosedLoop::ClosedLoop(LoopScene& scene, const SurfaceVelocity& surface, const DrivenRobot::Cycle& begin,
                       double standoff)
    : scene_(&scene), surface_(surface), robot_(begin.robot), now_(begin.time), standoff_(standoff) {}

Eigen::Isometry3d ClosedLoop::X_MT() const {
  Eigen::Isometry3d X_MT = robot_.pose();
  X_MT.translation() -= surface_.poseAt(now_).translation();
  return X_MT;
}

Twist ClosedLoop::guarded(const Twist& command_W) {
  if (!guard_) return command_W;
  const Eigen::Isometry3d X_WT = robot_.pose();
  const double reach = guard_->options().reach;
  guard_->measure(X_WT, scene_->proximityAt(X_WT, surface_.poseAt(now_), now_, reach), now_);
  return guard_->guard(command_W, kCommandPeriod, now_);
}

Twist ClosedLoop::watch(const Twist& command_W, const DrivenRobot::Cycle& next) {
  Twist output_W = guarded(command_W);
  robot_ = next.robot;
  now_ = next.time;
  return output_W;
}

LoopCycle::Contact ClosedLoop::speedsAt(const Separation& apart) const {
  const Twist& velocity_W = robot_.velocity_W();
  const Eigen::Vector3d from_origin_W = apart.on_tool - X_MT().translation();
  const double tool = 0.0 - apart.normal.dot(velocity_W.v_W + velocity_W.w_W.cross(from_origin_W));
  return {tool + apart.normal.dot(surface_.v_W), tool};
}

LoopCycle ClosedLoop::run(const Twist& command_W) {
  LoopCycle cycle;
  cycle.command_W = command_W;
  cycle.output_W = guarded(command_W);
  robot_.send(cycle.output_W);
  Separation apart = scene_->separationAt(X_MT());
  std::vector<Eigen::Isometry3d> path_MT = {X_MT()};
  std::vector<double> gaps = {apart.gap};
  std::vector<LoopCycle::Contact> speeds;
  for (sweep_guard_core::Duration step{}; step < kCommandPeriod; step += SimulatedRobot::kStep) {
    robot_.step();
    speeds.push_back(speedsAt(apart));  // between this pose and the next one
    now_ += SimulatedRobot::kStep;
    path_MT.push_back(X_MT());
    const Separation next = scene_->separationAt(path_MT.back());
    if (next.gap > 0.0) apart = next;  // the normal of an overlap means nothing
    gaps.push_back(next.gap);
    if (next.gap > standoff_ + kAtStandoff) continue;
    cycle.standoff_speed = std::max(cycle.standoff_speed, speeds.back().closing_speed);
  }
  cycle.gap = gaps.front();
  cycle.least_gap = *std::min_element(gaps.begin(), gaps.end());
  if (const auto step = scene_->firstContact(path_MT, gaps)) cycle.contact = speeds[*step];
  return cycle;
}

}  // namespace sweep_guard_evaluation
