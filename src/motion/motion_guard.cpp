#include "sweep_guard/motion/motion_guard.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr size_t kBalls = 4096;  // before buffers grow

Twist scaled(const Twist& twist_W, double scale) { return {scale * twist_W.v_W, scale * twist_W.w_W}; }

}  // namespace

MotionGuard::MotionGuard(const MotionGuardOptions& options) : options_(options), limiter_(kBalls) {
  requireUsable(options_);
  facing_.reserve(kBalls);
  plane_of_.reserve(kBalls);
}

GuardedMotion MotionGuard::guard(const MotionInputs& inputs, const MotionCommand& command, const Instant& now) {
  sweep_guard_core::requireUsable(command.twist_W);
  GuardedMotion motion;
  motion.decision = permission(inputs, command.timestamps, now);
  motion.commanded_speed =
      fastestPoint(command.twist_W, inputs.tool ? radiusAbout(command.point_T, *inputs.tool) : 0.0);
  if (inputs.planes) motion.planes_age = age(inputs.planes->timestamps, now);
  if (motion.decision.permission == Permission::kStop) {
    stop(now.steady);
  } else {
    limit(inputs, command, now, motion);
    const Eigen::Vector3d to_origin_W = -(inputs.pose->X_WT.linear() * command.point_T);
    in_flight_.add(atPoint(motion.twist_W, to_origin_W), now.steady);
  }
  return motion;
}

PermissionDecision MotionGuard::permission(const MotionInputs& inputs, const Timestamps& command,
                                           const Instant& now) const {
  const PermissionDecision decision = decidePermission(inputs, command, now, options_);
  if (decision.permission == Permission::kStop || !inputs.jointsMoveTool()) return decision;
  return {Permission::kStop, PermissionCause::kMovingJoints};
}

void MotionGuard::stop(SteadyTime now) { in_flight_.add({}, now); }

void MotionGuard::limit(const MotionInputs& inputs, const MotionCommand& command, const Instant& now,
                        GuardedMotion& motion) {
  const BrakingLimits limits = brakingLimits(inputs, command, now);
  const Eigen::Isometry3d expected_WT = expectedPose(inputs, command, now);
  facing_.clear();
  plane_of_.clear();
  collectFacing(inputs, command, inputs.pose->X_WT);
  collectFacing(inputs, command, expected_WT);
  UncoveredSurfaces uncovered = inputs.planes->uncovered;
  // Planes are carried by the newest pose. A distance as a whole cannot be: any point may have come nearer.
  const double radius = radiusAbout(Eigen::Vector3d::Zero(), *inputs.tool);
  uncovered.distance -= std::max(largestDisplacement(inputs.planes->X_WT, inputs.pose->X_WT, radius),
                                 largestDisplacement(inputs.planes->X_WT, expected_WT, radius));

  Twist command_W = command.twist_W;
  if (motion.decision.cause == PermissionCause::kUnseen && motion.commanded_speed > options_.unseen_speed)
    command_W = scaled(command_W, options_.unseen_speed / motion.commanded_speed);
  motion.twist_W = motion.decision.permission == Permission::kLimited
                       ? limiter_.limit(command_W, facing_, uncovered, limits)
                       : escapeVelocity(command.twist_W, facing_, uncovered, limits, options_.escape_speed);
  motion.sent_speed = fastestPoint(motion.twist_W, limits.tool_radius);
  motion.scale = motion.commanded_speed > 0.0 ? std::min(1.0, motion.sent_speed / motion.commanded_speed) : 1.0;
  motion.limiting = limiting(command_W, limits);
}

// The planes bound the speed from where the tool is. What was sent lately is not in the newest pose yet.
Eigen::Isometry3d MotionGuard::expectedPose(const MotionInputs& inputs, const MotionCommand& command,
                                            const Instant& now) const {
  if (command.rest_WT) return *command.rest_WT;
  return in_flight_.expectedPose(inputs.pose->X_WT, now.steady,
                                 age(inputs.pose->timestamps, now) + options_.settlingTime());
}

BrakingLimits MotionGuard::brakingLimits(const MotionInputs& inputs, const MotionCommand& command,
                                         const Instant& now) const {
  const Duration age_of_inputs = std::max(age(inputs.planes->timestamps, now), age(inputs.pose->timestamps, now));
  BrakingLimits limits = options_.brakingLimits(command.period, age_of_inputs);
  limits.tool_radius = radiusAbout(command.point_T, *inputs.tool);
  return limits;
}

void MotionGuard::collectFacing(const MotionInputs& inputs, const MotionCommand& command,
                                const Eigen::Isometry3d& X_WT) {
  const Eigen::Vector3d to_point_W = X_WT.linear() * command.point_T;
  for (size_t i = 0; i < inputs.planes->planes.size(); ++i) {
    const SeparatingPlane& plane = inputs.planes->planes[i];
    const size_t before = facing_.size();
    addFacingBalls(plane, inputs.tool->pieces[plane.piece], X_WT, facing_);
    for (size_t j = before; j < facing_.size(); ++j) facing_[j].center_W -= to_point_W;
    plane_of_.resize(facing_.size(), i);
  }
}

std::optional<GuardedMotion::Limiting> MotionGuard::limiting(const Twist& command_W,
                                                             const BrakingLimits& limits) const {
  std::optional<GuardedMotion::Limiting> most;
  double largest_excess = 0.0;
  for (size_t i = 0; i < facing_.size(); ++i) {
    const ClosingRow row(facing_[i], command_W, limits);
    const double excess = row.closing(command_W.v_W, 1.0) - row.limit;
    if (excess <= largest_excess) continue;
    largest_excess = excess;
    most = GuardedMotion::Limiting{plane_of_[i], row.normal_W, facing_[i].gap, row.limit};
  }
  return most;
}

}  // namespace sweep_guard_core
