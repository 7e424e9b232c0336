#include "prediction/motion_tracker.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr auto kGap = std::chrono::milliseconds(250);
constexpr Duration kMaxGap = std::chrono::seconds(1);
constexpr Duration kMinPeriod = std::chrono::microseconds(500);  // too short to compute a speed
constexpr Duration kJitter = std::chrono::milliseconds(10);      // error of a stamp that does not make a jump

}  // namespace

template <typename Space>
typename MotionTracker<Space>::Step MotionTracker<Space>::add(const Sample& sample) {
  const Duration period = samples_ > 0 ? sample.stamp - newest_.stamp : Duration::zero();
  const Vector moved = samples_ > 0 ? Space::displacementOf(newest_, sample) : Vector::Zero();
  const bool corrects = samples_ > 0 && period < kMinPeriod;
  if (samples_ == 0 || space_.exceeds(moved, toSeconds(std::max<Duration>(period, kJitter))) || gap(period)) {
    step_ = Step::kBegins;
    coordinates_.setZero();
    samples_ = 1;
  } else {
    step_ = corrects ? Step::kCorrects : Step::kContinues;
    coordinates_ += moved;
    samples_ += corrects ? 0 : 1;
  }
  if (!corrects) period_ = period > kMaxGap ? Duration::zero() : period;
  const Time stamp = step_ == Step::kCorrects ? newest_.stamp : sample.stamp;
  newest_ = sample;
  newest_.stamp = stamp;
  return step_;
}

template <typename Space>
bool MotionTracker<Space>::gap(Duration period) const {
  return period > std::clamp<Duration>(3 * period_, kGap, kMaxGap);
}

template class MotionTracker<PoseSpace>;
template class MotionTracker<JointSpace>;

template <typename Space>
void follow(PolynomialFit<Space::kSize>& fit, const MotionTracker<Space>& tracker) {
  using Step = typename MotionTracker<Space>::Step;
  if (tracker.step() == Step::kCorrects) {
    fit.replaceNewest(tracker.coordinates());
    return;
  }
  if (tracker.step() == Step::kBegins) fit.clear();
  fit.add(tracker.newest().stamp, tracker.coordinates());
}

template <typename Space>
void Velocity<Space>::observe(const MotionTracker<Space>& tracker) {
  follow(fit_, tracker);
  typename PolynomialFit<Space::kSize>::Degrees straight;
  straight.fill(1);
  value_ = tracker.space().limitedTo(fit_.curve(straight).slopeAt(tracker.newest().stamp), 1.0);
}

template void follow(PolynomialFit<PoseSpace::kSize>& fit, const PoseTracker& tracker);
template void follow(PolynomialFit<JointSpace::kSize>& fit, const JointTracker& tracker);
template class Velocity<PoseSpace>;
template class Velocity<JointSpace>;

}  // namespace sweep_guard_core
