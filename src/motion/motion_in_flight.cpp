#include "sweep_guard/motion/motion_in_flight.h"

#include <algorithm>

namespace sweep_guard_core {

void MotionInFlight::add(const Twist& twist_W, SteadyTime sent) {
  ring_[next_] = {twist_W, sent};
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

Eigen::Isometry3d MotionInFlight::expectedPose(const Eigen::Isometry3d& X_WT, SteadyTime now, Duration window) const {
  Eigen::Vector3d moved_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d turned_W = Eigen::Vector3d::Zero();
  SteadyTime until = now;
  for (size_t i = 0; i < count_ && until > now - window; ++i) {
    const Sent& sent = before(i);
    const double seconds = toSeconds(until - std::max(sent.sent, now - window));
    moved_W += seconds * sent.twist_W.v_W;
    turned_W += seconds * sent.twist_W.w_W;
    until = sent.sent;
  }
  Eigen::Isometry3d expected_WT = X_WT;
  expected_WT.translation() += moved_W;
  const double angle = turned_W.norm();
  if (angle > 0.0) expected_WT.linear() = Eigen::AngleAxisd(angle, turned_W / angle) * X_WT.linear();
  return expected_WT;
}

}  // namespace sweep_guard_core
