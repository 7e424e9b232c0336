#include "evaluation/closed_loop.h"

#include <algorithm>

#include "detection/placed_core.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::Separation;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::toSeconds;
using sweep_guard_core::Twist;

namespace {

constexpr double kSwept = 0.02;      // [m] from here on steps are swept; a step is shorter
constexpr double kAtStandoff = 2e-5;  // [m] the standoff is reached

}  // namespace

SweptContact::SweptContact(const sweep_guard_core::ConvexShape& tool, const SquareObstacle& square)
    : tool_(tool), mesh_M_(meshOf(square)), detector_(sweep_guard_core::makeDetector("reference")) {
  for (size_t i = 0; i < corners_.size(); ++i) corners_[i] = mesh_M_.vertex(i);
}

Separation SweptContact::separationAt(const Eigen::Isometry3d& X_MT) const {
  const sweep_guard_core::PlacedCore core{tool_.whole(), X_MT.linear(), X_MT.translation()};
  Separation apart = separation(core, sweep_guard_core::PointHull(corners_));
  apart.gap -= tool_.whole().padding();
  return apart;
}

std::optional<size_t> SweptContact::firstContact(const std::vector<Eigen::Isometry3d>& path_MT,
                                                 const std::vector<double>& gaps) {
  if (*std::min_element(gaps.begin(), gaps.end()) > kSwept) return std::nullopt;
  return checkPath(*detector_, {tool_, path_MT, mesh_M_}).first_contact;
}

ClosedLoop::ClosedLoop(SweptContact& contact, const LoopSurface& surface, const SimulatedRobot& robot,
                       const LoopGuardOptions* guard, double standoff)
    : contact_(&contact), surface_(surface), robot_(robot), standoff_(standoff) {
  if (guard != nullptr) guard_.emplace(*guard);
}

void ClosedLoop::watch(const SimulatedRobot& robot, const Twist& command_W, Duration before) {
  if (!guard_) return;
  measure(robot, now_ - before);
  guard_->sent(command_W, SteadyTime(now_ - before));
}

void ClosedLoop::measure(const SimulatedRobot& robot, Duration time) {
  auto corners_W = contact_->corners();
  for (Eigen::Vector3d& corner : corners_W) corner += moved(time);
  guard_->measure(robot.pose(), corners_W, surface_.velocity_W, SteadyTime(time));
}

Eigen::Isometry3d ClosedLoop::pose_M() const {
  Eigen::Isometry3d X_MT = robot_.pose();
  X_MT.translation() -= moved(now_);
  return X_MT;
}

double ClosedLoop::closingSpeed(const Separation& apart) const {
  const Twist& velocity_W = robot_.velocity_W();
  const Eigen::Vector3d from_origin = apart.on_tool - pose_M().translation();
  return -apart.normal.dot(velocity_W.v_W + velocity_W.w_W.cross(from_origin) - surface_.velocity_W);
}

ClosedLoop::Cycle ClosedLoop::run(const Twist& command_W) {
  Cycle cycle;
  cycle.output_W = command_W;
  if (guard_) {
    measure(robot_, now_);
    cycle.output_W = guard_->limit(command_W, SteadyTime(now_));
    guard_->sent(cycle.output_W, SteadyTime(now_));
  }
  robot_.send(cycle.output_W);
  std::vector<Eigen::Isometry3d> path = {pose_M()};
  std::vector<double> gaps = {contact_->separationAt(path[0]).gap};
  std::vector<double> speeds;
  for (Duration step{}; step < kCommandPeriod; step += SimulatedRobot::kStep) {
    robot_.step();
    now_ += SimulatedRobot::kStep;
    path.push_back(pose_M());
    const Separation apart = contact_->separationAt(path.back());
    gaps.push_back(apart.gap);
    if (apart.gap > 0.0) speeds.push_back(closingSpeed(apart));
    else speeds.push_back(speeds.empty() ? 0.0 : speeds.back());
    if (apart.gap <= standoff_ + kAtStandoff) cycle.fastest_at_standoff = std::max(cycle.fastest_at_standoff, speeds.back());
  }
  cycle.gap = gaps.front();
  cycle.least_gap = *std::min_element(gaps.begin(), gaps.end());
  if (const auto step = contact_->firstContact(path, gaps)) cycle.contact_speed = speeds[*step];
  return cycle;
}

}  // namespace sweep_guard_evaluation
