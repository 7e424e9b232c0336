#include "simulation/guided_tip.h"

#include <algorithm>
#include <cmath>

#include "motion/rotation_vector.h"
#include "prediction/motion_space.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using Eigen::Vector3d;
using sweep_guard_core::limited;

namespace {

constexpr double kApproachTime = 0.1;  // [s] time constant at the end of the approach

// Both branches need at most half of the acceleration: v = sqrt(a d), and v = d / tau where that would stop late.
Vector3d approachVelocity(const Vector3d& offset, double acceleration, double dt) {
  const double distance = offset.norm();
  if (distance == 0.0) return Vector3d::Zero();
  const double time_constant = std::max(kApproachTime, 2.0 * dt);
  return offset / distance * std::min(distance / time_constant, std::sqrt(acceleration * distance));
}

}  // namespace

GuidedTip::GuidedTip(const Eigen::Isometry3d& X_WT, const Limits& limits) : X_WT_(X_WT), limits_(limits) {
  for (const double limit : {limits.speed, limits.acceleration, limits.turn_rate, limits.turn_acceleration}) {
    if (!(limit > 0.0)) throw sweep_guard_core::InvalidInput("a limit of the guided motion is not above 0");
  }
}

void GuidedTip::moveAt(const Twist& desired, double dt) {
  const Vector3d linear = limited(desired.v_W, limits_.speed);
  const Vector3d angular = limited(desired.w_W, limits_.turn_rate);
  velocity_.v_W += limited(linear - velocity_.v_W, limits_.acceleration * dt);
  velocity_.w_W += limited(angular - velocity_.w_W, limits_.turn_acceleration * dt);
  X_WT_.translation() += velocity_.v_W * dt;
  const Vector3d turn = velocity_.w_W * dt;
  const Eigen::Quaterniond turned =
      Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()) * Eigen::Quaterniond(X_WT_.linear());
  X_WT_.linear() = turned.normalized().toRotationMatrix();
}

void GuidedTip::moveTowards(const Eigen::Isometry3d& goal_W, double dt) {
  const Vector3d offset = goal_W.translation() - X_WT_.translation();
  const Vector3d turn = sweep_guard_core::rotationVector(goal_W.linear() * X_WT_.linear().transpose());
  moveAt({approachVelocity(offset, limits_.acceleration, dt), approachVelocity(turn, limits_.turn_acceleration, dt)},
         dt);
}

GuidedTip::Limits readLimits(sweep_guard_ros::ParameterReader& parameters, const std::string& group,
                             GuidedTip::Limits limits) {
  limits.speed = parameters.number(group + "speed", limits.speed, {0.001, 5.0});
  limits.acceleration = parameters.number(group + "acceleration", limits.acceleration, {0.01, 100.0});
  limits.turn_rate = parameters.number(group + "turn_rate", limits.turn_rate, {0.01, 20.0});
  limits.turn_acceleration = parameters.number(group + "turn_acceleration", limits.turn_acceleration, {0.1, 1000.0});
  return limits;
}

Eigen::Isometry3d pointingDown(const Vector3d& p_W) {
  return Eigen::Translation3d(p_W) * Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
}

}  // namespace sweep_guard_simulation
