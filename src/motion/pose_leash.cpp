#include "sweep_guard/motion/pose_leash.h"

#include <algorithm>

#include "motion/rotation_vector.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kFollows = 0.1;  // least share of its lag that a tool which follows has moved
constexpr double kSamplesAWindow = 16.0;
constexpr Duration kSpeedWindow = std::chrono::milliseconds(20);  // that a speed is measured over

}  // namespace

double secondsBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double max_speed, double max_turn_rate) {
  const double turned = rotationVector(b.linear() * a.linear().transpose()).norm();
  return std::max((b.translation() - a.translation()).norm() / max_speed, turned / max_turn_rate);
}

PoseLeash::PoseLeash(const Options& options)
    : options_(options), lag_(std::max<Duration>(options.time_constant, kLeastLag)) {
  if (!(options.max_speed > 0.0)) throw InvalidInput("largest speed of commanded poses: must be > 0 m/s");
  if (!(options.max_turn_rate > 0.0)) throw InvalidInput("largest turn rate of commanded poses: must be > 0 rad/s");
  if (!(options.deceleration > 0.0)) throw InvalidInput("deceleration: must be > 0 m/s^2");
  if (options.dead_time < Duration::zero() || options.time_constant < Duration::zero()) {
    throw InvalidInput("lag of the robot: must be >= 0 s");
  }
}

void PoseLeash::clear() {
  count_ = 0;
  moved_on_ = false;
  stood_WT_.reset();
}

void PoseLeash::observe(const Observation& seen, const Eigen::Isometry3d& sent_WT) {
  moved_on_ = moved_on_ || (count_ > 0 && sent_WT.matrix() != sent_WT_.matrix());
  seen_ = seen;
  if (hasStood(sent_WT)) {
    stood_WT_ = seen.X_WT;
    moved_on_ = false;
  } else if (stood_WT_ && between(*stood_WT_, seen.X_WT) >= toSeconds(options_.dead_time + seen.period + seen.age)) {
    stood_WT_.reset();
  }
  sent_WT_ = within(sent_WT);
  remember(sent_WT);
}

void PoseLeash::remember(const Eigen::Isometry3d& sent_WT) {
  const double spacing = toSeconds(options_.dead_time + 2 * lag_ + seen_.period + seen_.age) / kSamplesAWindow;
  if (count_ > 0 && toSeconds(seen_.now - before(0).now) < spacing) return;
  ring_[next_] = seen_;
  ring_[next_].sent_WT = sent_WT;
  next_ = (next_ + 1) % kSamples;
  count_ = std::min(count_ + 1, kSamples);
}

double PoseLeash::reach() const {
  const double lag = toSeconds(lag_);
  const double whole = lag + toSeconds(options_.dead_time + seen_.period + seen_.age);
  return stood_WT_ ? std::min(whole, lag + between(*stood_WT_, seen_.X_WT)) : whole;
}

bool PoseLeash::keepsWaiting(const Eigen::Isometry3d& sent_WT) const {
  return stood_WT_ && between(seen_.X_WT, sent_WT) > kFollows * toSeconds(lag_);
}

// Once it was found not to follow, nothing more is told by a pose that has not moved on since.
bool PoseLeash::hasStood(const Eigen::Isometry3d& sent_WT) const {
  if (!moved_on_ || between(seen_.X_WT, sent_WT) <= toSeconds(lag_)) return false;
  const SteadyTime begin = seen_.now - (options_.dead_time + 2 * lag_ + seen_.period + seen_.age);
  double moved = 0.0;
  for (size_t i = 0; i < count_; ++i) {
    const Observation& sample = before(i);
    moved = std::max(moved, between(sample.X_WT, seen_.X_WT));
    if (sample.now <= begin) return moved < kFollows * between(sample.X_WT, sample.sent_WT);
  }
  return false;
}

Eigen::Isometry3d PoseLeash::within(const Eigen::Isometry3d& pose_WT) const {
  Eigen::Vector3d offset_W = pose_WT.translation() - seen_.X_WT.translation();
  Eigen::Vector3d turn_W = rotationVector(pose_WT.linear() * seen_.X_WT.linear().transpose());
  const double seconds = reach();
  Eigen::Isometry3d within_WT = pose_WT;
  if (shorten(offset_W, seconds * options_.max_speed)) within_WT.translation() = seen_.X_WT.translation() + offset_W;
  if (shorten(turn_W, seconds * options_.max_turn_rate)) within_WT.linear() = turnedBy(seen_.X_WT.linear(), turn_W);
  return within_WT;
}

Eigen::Isometry3d PoseLeash::rest(const Eigen::Isometry3d& sent_WT) const {
  const double speed = approach(sent_WT);
  const double braking = 0.5 * speed * speed * options_.max_speed / options_.deceleration;
  const double stopping = speed * toSeconds(seen_.age + options_.dead_time) + braking;
  const double lead = between(seen_.X_WT, sent_WT);
  if (lead <= stopping) return sent_WT;
  const Eigen::Vector3d turn_W = rotationVector(sent_WT.linear() * seen_.X_WT.linear().transpose());
  Eigen::Isometry3d rest_WT = seen_.X_WT;
  rest_WT.translation() += stopping / lead * (sent_WT.translation() - seen_.X_WT.translation());
  rest_WT.linear() = turnedBy(seen_.X_WT.linear(), stopping / lead * turn_W);
  return rest_WT;
}

// Returns how fast the tool comes nearer to the pose sent last, in its largest speed; 0 if it does not, or before it was
// seen for long enough.
double PoseLeash::approach(const Eigen::Isometry3d& sent_WT) const {
  const SteadyTime measured = seen_.now - seen_.age;
  for (size_t i = 0; i < count_; ++i) {
    const Observation& sample = before(i);
    const Duration passed = measured - (sample.now - sample.age);
    if (passed < kSpeedWindow) continue;
    const double nearer = between(sample.X_WT, sent_WT) - between(seen_.X_WT, sent_WT);
    return std::max(0.0, nearer / toSeconds(passed));
  }
  return 0.0;
}

}  // namespace sweep_guard_core
