#include "prediction/pose_tracker.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr auto kGap = std::chrono::milliseconds(250);
constexpr Duration kMaxGap = std::chrono::seconds(1);
constexpr Duration kMinPeriod = std::chrono::microseconds(500);  // too short to compute a speed
constexpr Duration kJitter = std::chrono::milliseconds(10);      // error of a stamp that does not make a jump

}  // namespace

PoseTracker::Step PoseTracker::add(const StampedPose& pose) {
  const Duration period = poses_ > 0 ? pose.stamp - newest_.stamp : Duration::zero();
  const Vector6d moved = poses_ > 0 ? displacement(newest_.X_WT, pose.X_WT) : Vector6d::Zero();
  const bool corrects = poses_ > 0 && period < kMinPeriod;
  if (poses_ == 0 || tooFar(moved, period) || gap(period)) {
    step_ = Step::kBegins;
    coordinates_.setZero();
    poses_ = 1;
  } else {
    step_ = corrects ? Step::kCorrects : Step::kContinues;
    coordinates_ += moved;
    poses_ += corrects ? 0 : 1;
  }
  if (!corrects) period_ = period > kMaxGap ? Duration::zero() : period;
  newest_ = {step_ == Step::kCorrects ? newest_.stamp : pose.stamp, pose.X_WT};
  return step_;
}

bool PoseTracker::tooFar(const Vector6d& moved, Duration period) const {
  const double seconds = toSeconds(std::max(period, kJitter));
  return moved.head<3>().norm() > max_speed_ * seconds || moved.tail<3>().norm() > max_turn_rate_ * seconds;
}

bool PoseTracker::gap(Duration period) const { return period > std::clamp<Duration>(3 * period_, kGap, kMaxGap); }

}  // namespace sweep_guard_core
