#include "sweep_guard/motion/pose_follower.h"

#include <cassert>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// Returns the rotation vector of R in W [rad], at most pi long.
Eigen::Vector3d rotationVector(const Eigen::Matrix3d& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

bool clip(Eigen::Vector3d& velocity, double limit) {
  const double speed = velocity.norm();
  if (speed <= limit) return false;
  velocity *= limit / speed;
  return true;
}

}  // namespace

PoseFollower::PoseFollower(const Options& options) : options_(options) {
  if (!(options.max_speed > 0.0)) throw InvalidInput("largest speed of commanded poses: must be > 0 m/s");
  if (!(options.max_turn_rate > 0.0)) throw InvalidInput("largest turn rate of commanded poses: must be > 0 rad/s");
}

void PoseFollower::begin(const Eigen::Isometry3d& X_WT) {
  sent_WT_ = X_WT;
  reached_ = false;
  rebase();
}

void PoseFollower::end() {
  sent_WT_.reset();
  reached_ = false;
  rebase();
}

Twist PoseFollower::towards(const Eigen::Isometry3d& command_WT, Duration period) {
  assert(begun());
  goal_WT_ = command_WT;
  if (options_.mode == PoseMode::kIncremental) {
    const Eigen::Isometry3d& before_WT = command_WT_ ? *command_WT_ : command_WT;
    goal_WT_.translation() = sent_WT_->translation() + (command_WT.translation() - before_WT.translation());
    goal_WT_.linear() = command_WT.linear() * before_WT.linear().transpose() * sent_WT_->linear();
  }
  const bool moves = options_.mode == PoseMode::kAbsolute || command_WT_;
  command_WT_ = command_WT;
  period_ = period;
  wanted_W_ = {};
  leads_there_ = moves;
  if (!moves) return wanted_W_;
  wanted_W_.v_W = (goal_WT_.translation() - sent_WT_->translation()) / toSeconds(period);
  wanted_W_.w_W = rotationVector(goal_WT_.linear() * sent_WT_->linear().transpose()) / toSeconds(period);
  const bool too_far = clip(wanted_W_.v_W, options_.max_speed);
  const bool too_turned = clip(wanted_W_.w_W, options_.max_turn_rate);
  leads_there_ = !too_far && !too_turned;
  return wanted_W_;
}

const Eigen::Isometry3d& PoseFollower::moveOn(const Twist& let_through_W) {
  const bool reached = leads_there_ && let_through_W == wanted_W_;
  reached_ = reached && options_.mode == PoseMode::kAbsolute;
  if (reached) {
    sent_WT_ = goal_WT_;
  } else {
    const double seconds = toSeconds(period_);
    const Eigen::Matrix3d R_WT = rotationOf(seconds * let_through_W.w_W) * sent_WT_->linear();
    sent_WT_->translation() += seconds * let_through_W.v_W;
    sent_WT_->linear() = Eigen::Quaterniond(R_WT).normalized().toRotationMatrix();
  }
  return *sent_WT_;
}

}  // namespace sweep_guard_core
