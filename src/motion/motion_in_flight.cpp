#include "sweep_guard/motion/motion_in_flight.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr Duration kTwoShortest = std::chrono::milliseconds(2);  // periods

}  // namespace

void MotionInFlight::add(const Twist& twist_W, SteadyTime sent) {
  if (count_ >= 2 && sent - before(1).stamp < kTwoShortest) joinNewest(sent);
  ring_[next_] = {sent, twist_W};
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

// The newest two become one that moves the tool as far until then.
void MotionInFlight::joinNewest(SteadyTime until) {
  const Sent newest = before(0);
  next_ = placeBefore(next_, 0);
  --count_;
  Sent& joined = ring_[placeBefore(next_, 0)];
  const Duration whole = until - joined.stamp;
  const double share = whole > Duration::zero() ? toSeconds(until - newest.stamp) / toSeconds(whole) : 1.0;
  joined.value.v_W += share * (newest.value.v_W - joined.value.v_W);
  joined.value.w_W += share * (newest.value.w_W - joined.value.w_W);
}

Eigen::Isometry3d MotionInFlight::expectedPose(const Eigen::Isometry3d& X_WT, SteadyTime now, Duration window) const {
  Eigen::Vector3d moved_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d turned_W = Eigen::Vector3d::Zero();
  SteadyTime until = now;
  for (size_t i = 0; i < count_ && until > now - window; ++i) {
    const Sent& sent = before(i);
    const double seconds = toSeconds(until - std::max(sent.stamp, now - window));
    moved_W += seconds * sent.value.v_W;
    turned_W += seconds * sent.value.w_W;
    until = sent.stamp;
  }
  Eigen::Isometry3d expected_WT = X_WT;
  expected_WT.translation() += moved_W;
  const double angle = turned_W.norm();
  if (angle > 0.0) expected_WT.linear() = Eigen::AngleAxisd(angle, turned_W / angle) * X_WT.linear();
  return expected_WT;
}

}  // namespace sweep_guard_core
