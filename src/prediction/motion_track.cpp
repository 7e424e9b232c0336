#include "sweep_guard/prediction/motion_track.h"

#include <algorithm>

namespace sweep_guard {
namespace {

constexpr auto kGap = std::chrono::milliseconds(250);
constexpr Duration kLongestGap = std::chrono::seconds(1);
constexpr double kShortestPeriod = 0.01;  // [s] stamps cut or jittered by this do not make a jump

}  // namespace

MotionTrack::Step MotionTrack::add(const StampedPose& pose) {
  const Duration period = pose.stamp - newest_.stamp;
  if (poses_ > 0 && period <= Duration::zero()) {
    coordinates_ += displacement(newest_.X_WT, pose.X_WT);
    newest_.X_WT = pose.X_WT;
    return step_ = Step::kCorrects;
  }
  const Vector6d moved = poses_ > 0 ? displacement(newest_.X_WT, pose.X_WT) : Vector6d::Zero();
  const bool begins = poses_ == 0 || interrupted(moved, period);
  coordinates_ = begins ? Vector6d::Zero() : Vector6d(coordinates_ + moved);
  poses_ = begins ? 1 : poses_ + 1;
  period_ = newest_.stamp == Time() ? Duration::zero() : period;
  newest_ = pose;
  return step_ = begins ? Step::kBegins : Step::kContinues;
}

bool MotionTrack::interrupted(const Vector6d& moved, Duration period) const {
  const double seconds = std::max(toSeconds(period), kShortestPeriod);
  return period > std::clamp<Duration>(3 * period_, kGap, kLongestGap) ||
         moved.head<3>().norm() > max_speed_ * seconds || moved.tail<3>().norm() > max_turn_rate_ * seconds;
}

}  // namespace sweep_guard
