#include "prediction/motion_tracker.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr auto kGap = std::chrono::milliseconds(250);
constexpr Duration kMaxGap = std::chrono::seconds(1);
constexpr Duration kMinPeriod = std::chrono::microseconds(500);  // too short to compute a speed
constexpr Duration kJitter = std::chrono::milliseconds(10);      // error of a stamp that does not make a jump
constexpr Duration kSpan = std::chrono::milliseconds(20);        // that samples need that come in bursts

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
  if (step_ == Step::kContinues) notePeriod(toSeconds(period));
  const Time stamp = step_ == Step::kCorrects ? newest_.stamp : sample.stamp;
  newest_ = sample;
  newest_.stamp = stamp;
  return step_;
}

template <typename Space>
bool MotionTracker<Space>::gap(Duration period) const {
  return period > std::clamp<Duration>(3 * period_, kGap, kMaxGap);
}

// A pause counts for about as long as a gap lasts.
template <typename Space>
void MotionTracker<Space>::notePeriod(double seconds) {
  const double kept = std::max(0.0, 1.0 - seconds / toSeconds(kGap));
  longest_period_ = std::max(seconds, kept * longest_period_);
}

template <typename Space>
bool MotionTracker<Space>::isSilentAt(Time stamp) const {
  if (samples_ == 0) return true;
  const Duration longest = samples_ == 1 ? kMaxGap : std::max<Duration>(kSpan, fromSeconds(3 * longest_period_));
  return stamp - newest_.stamp > longest;
}

// Half a period: regular samples are farther apart, whatever their jitter.
template <typename Space>
Duration MotionTracker<Space>::leastSpan() const {
  return std::min<Duration>(kSpan, fromSeconds(longest_period_ / 2.0));
}

template <typename Space>
double MotionTracker<Space>::trustIn(Duration span) const {
  const Duration least = leastSpan();
  return span >= least ? 1.0 : toSeconds(span) / toSeconds(least);
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
  fit.add(tracker.newest().stamp, tracker.coordinates(), tracker.leastSpan());
}

template <typename Space>
void Velocity<Space>::observe(const MotionTracker<Space>& tracker) {
  follow(fit_, tracker);
  typename PolynomialFit<Space::kSize>::Degrees straight;
  straight.fill(1);
  const Vector slope = fit_.curve(straight).slopeAt(tracker.newest().stamp);
  value_ = tracker.space().limitedTo(tracker.trustIn(fit_.span()) * slope, 1.0);
}

template void follow(PolynomialFit<PoseSpace::kSize>& fit, const PoseTracker& tracker);
template void follow(PolynomialFit<JointSpace::kSize>& fit, const JointTracker& tracker);
template class Velocity<PoseSpace>;
template class Velocity<JointSpace>;

}  // namespace sweep_guard_core
