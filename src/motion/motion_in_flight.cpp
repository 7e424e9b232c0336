#include "sweep_guard/motion/motion_in_flight.h"

#include <algorithm>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kTwoShortest = std::chrono::milliseconds(2);  // periods

}  // namespace

MotionInFlight::MotionInFlight(size_t dimension)
    : sent_(kCapacity), velocities_(static_cast<Eigen::Index>(dimension), static_cast<Eigen::Index>(kCapacity)) {}

void MotionInFlight::add(const Eigen::Ref<const Eigen::VectorXd>& velocity, SteadyTime sent) {
  if (count_ >= 2 && sent - sent_[placeBefore(next_, 1)] < kTwoShortest) joinNewest(sent);
  sent_[next_] = sent;
  velocityAt(next_) = velocity;
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

void MotionInFlight::add(const Twist& twist_W, SteadyTime sent) {
  add((Vector6d() << twist_W.v_W, twist_W.w_W).finished(), sent);
}

// The newest two become one that moves the robot as far until then.
void MotionInFlight::joinNewest(SteadyTime until) {
  const size_t newest = placeBefore(next_, 0);
  const size_t joined = placeBefore(next_, 1);
  next_ = newest;
  --count_;
  const Duration whole = until - sent_[joined];
  const double share = whole > Duration::zero() ? toSeconds(until - sent_[newest]) / toSeconds(whole) : 1.0;
  velocityAt(joined) += share * (velocityAt(newest) - velocityAt(joined));
}

void MotionInFlight::addUp(SteadyTime now, Duration window, Eigen::Ref<Eigen::VectorXd> displacement) const {
  displacement.setZero();
  SteadyTime until = now;
  for (size_t i = 0; i < count_ && until > now - window; ++i) {
    const size_t place = placeBefore(next_, i);
    displacement +=
        toSeconds(until - std::max(sent_[place], now - window)) * velocities_.col(static_cast<Eigen::Index>(place));
    until = sent_[place];
  }
}

Eigen::Isometry3d MotionInFlight::expectedPose(const Eigen::Isometry3d& X_WT, SteadyTime now, Duration window) const {
  Vector6d moved_W;
  addUp(now, window, moved_W);
  Eigen::Isometry3d expected_WT = X_WT;
  expected_WT.translation() += moved_W.head<3>();
  const Eigen::Vector3d turned_W = moved_W.tail<3>();
  const double angle = turned_W.norm();
  if (angle > 0.0) expected_WT.linear() = Eigen::AngleAxisd(angle, turned_W / angle) * X_WT.linear();
  return expected_WT;
}

}  // namespace sweep_guard_core
