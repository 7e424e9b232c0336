#include "sweep_guard/motion/pose_follower.h"

#include <cassert>

#include "motion/rotation_vector.h"

namespace sweep_guard_core {

void PoseFollower::begin(const Eigen::Isometry3d& X_WT) {
  end();
  sent_WT_ = X_WT;
}

void PoseFollower::end() {
  sent_WT_.reset();
  tool_WT_.reset();
  leash_.clear();
  held_ = false;
  reached_ = false;
  rebase();
}

void PoseFollower::observe(const PoseLeash::Observation& tool) {
  assert(begun());
  tool_WT_ = tool.X_WT;
  leash_.observe(tool, *sent_WT_);
  if (!held_ || !leash_.follows()) sent_WT_ = leash_.within(*sent_WT_);
}

void PoseFollower::takeBack() {
  assert(tool_WT_);
  sent_WT_ = *tool_WT_;
}

const Eigen::Isometry3d& PoseFollower::hold(bool tool_is_known) {
  assert(begun());
  if (!held_ && tool_is_known && tool_WT_) {
    sent_WT_ = leash_.rest(*sent_WT_);
    held_ = true;
  }
  reached_ = false;
  return *sent_WT_;
}

Eigen::Isometry3d PoseFollower::goalOf(const Eigen::Isometry3d& command_WT) const {
  if (!incremental_) return command_WT;
  const Eigen::Isometry3d& before_WT = command_WT_ ? *command_WT_ : command_WT;
  Eigen::Isometry3d goal_WT = *sent_WT_;
  goal_WT.translation() += command_WT.translation() - before_WT.translation();
  goal_WT.linear() = command_WT.linear() * before_WT.linear().transpose() * sent_WT_->linear();
  return goal_WT;
}

Twist PoseFollower::towards(const Eigen::Isometry3d& command_WT, Duration period) {
  assert(begun());
  const Eigen::Isometry3d goal_WT = goalOf(command_WT);
  goal_WT_ = tool_WT_ ? leash_.within(goal_WT) : goal_WT;
  is_command_ = !incremental_ && goal_WT_.matrix() == command_WT.matrix();
  const bool moves = !incremental_ || command_WT_;
  command_WT_ = command_WT;
  period_ = period;
  wanted_W_ = {};
  leads_there_ = moves;
  if (!moves) return wanted_W_;
  wanted_W_.v_W = (goal_WT_.translation() - sent_WT_->translation()) / toSeconds(period);
  wanted_W_.w_W = rotationVector(goal_WT_.linear() * sent_WT_->linear().transpose()) / toSeconds(period);
  const bool too_far = shorten(wanted_W_.v_W, options_.max_speed);
  const bool too_turned = shorten(wanted_W_.w_W, options_.max_turn_rate);
  leads_there_ = !too_far && !too_turned;
  return wanted_W_;
}

const Eigen::Isometry3d& PoseFollower::moveOn(const Twist& let_through_W) {
  const bool reached = leads_there_ && let_through_W == wanted_W_;
  reached_ = reached && is_command_;
  held_ = false;
  if (reached) {
    sent_WT_ = goal_WT_;
  } else {
    const double seconds = toSeconds(period_);
    sent_WT_->translation() += seconds * let_through_W.v_W;
    sent_WT_->linear() = turnedBy(sent_WT_->linear(), seconds * let_through_W.w_W);
  }
  return *sent_WT_;
}

}  // namespace sweep_guard_core
