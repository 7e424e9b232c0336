#include "evaluation/simulated_robot.h"

#include <cmath>
#include <utility>

#include "prediction/motion_space.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::limited;
using sweep_guard_core::toSeconds;
using sweep_guard_core::Twist;

namespace {

Eigen::Vector3d clipped(const Eigen::Vector3d& wanted, const Eigen::Vector3d& last, double fastest, double step) {
  return limited(last + limited(limited(wanted, fastest) - last, step), fastest);
}

double gainOf(Duration lag) {
  if (lag.count() == 0) return 1.0;
  return 1.0 - std::exp(-toSeconds(SimulatedRobot::kStep) / toSeconds(lag));
}

}  // namespace

Twist clipped(const Twist& wanted_W, const Twist& last_W, const RobotOptions& options, double period) {
  return {clipped(wanted_W.v_W, last_W.v_W, options.max_speed, options.max_acceleration * period),
          clipped(wanted_W.w_W, last_W.w_W, options.max_turn_rate, options.max_turn_acceleration * period)};
}

SimulatedRobot::SimulatedRobot(const Eigen::Isometry3d& X_WT, const RobotOptions& options)
    : p_WT_(X_WT.translation()),
      q_WT_(X_WT.linear()),
      gain_(gainOf(options.lag)),
      delayed_W_(static_cast<size_t>(options.dead_time / kStep)) {}

void SimulatedRobot::step() {
  Twist arriving_W = sent_W_;
  if (!delayed_W_.empty()) {
    std::swap(arriving_W, delayed_W_[oldest_]);
    oldest_ = (oldest_ + 1) % delayed_W_.size();
  }
  velocity_W_.v_W += gain_ * (arriving_W.v_W - velocity_W_.v_W);
  velocity_W_.w_W += gain_ * (arriving_W.w_W - velocity_W_.w_W);
  const double step = toSeconds(kStep);
  p_WT_ += step * velocity_W_.v_W;
  const double angle = step * velocity_W_.w_W.norm();
  if (angle == 0.0) return;
  q_WT_ = (Eigen::AngleAxisd(angle, velocity_W_.w_W.normalized()) * q_WT_).normalized();
}

Eigen::Isometry3d SimulatedRobot::pose() const {
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() = p_WT_;
  X_WT.linear() = q_WT_.toRotationMatrix();
  return X_WT;
}

}  // namespace sweep_guard_evaluation
