#include "sweep_guard/haptics/passivity_controller.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr double kPause = 0.06;                      // between positions that do not come one after the other [s]
constexpr double kKept = 0.995;                      // of the longest cycle, with each position
constexpr double kRounding = 1e-9;                   // relative, of a displacement
constexpr auto kForgiven = std::chrono::seconds(1);  // without a wanted force until what was given is forgotten

}  // namespace

double PassivityController::tolerance() const {
  return options_.max_effort * options_.max_speed * toSeconds(options_.period);
}

// Visits the efforts that may have acted between the newest known position and `until`, the newest first. Before the oldest
// one that is kept, none acted, or its energy is charged already.
template <typename Visit>
void PassivityController::visitActing(SteadyTime until, const Visit& visit) const {
  SteadyTime next = SteadyTime::max();
  for (size_t i = 0; i < count_; ++i) {
    const Sent& sent = before(i);
    if (next != SteadyTime::max() && next + options_.output_delay <= *known_) return;
    if (sent.stamp < until) visit(sent, std::min(next, until));
    next = sent.stamp;
  }
  if (*known_ < next) visit(Sent{*known_, 0.0}, std::min(next, until));
}

void PassivityController::moved(double displacement, SteadyTime until, double doubt) {
  if (!known_) known_ = until;
  until = std::max(until, *known_);
  double lowest = 0.0;
  double highest = 0.0;
  bool first = true;
  visitActing(until, [&](const Sent& sent, SteadyTime /*next*/) {
    lowest = first ? sent.value : std::min(lowest, sent.value);
    highest = first ? sent.value : std::max(highest, sent.value);
    first = false;
  });
  interval_ = seconds(until);
  const double farthest = std::abs(displacement) + doubt;
  const double deviation = options_.max_acceleration * interval_ * interval_ / 2;
  const double path = std::max(farthest, std::min(options_.max_speed * interval_, farthest + deviation));
  const double middle = (lowest + highest) / 2;
  const double known = middle * displacement + std::abs(middle) * doubt + (highest - lowest) / 2 * path;
  const bool within_limits = farthest - 2.0 * doubt <= (1.0 + kRounding) * maxDisplacement(interval_);
  const double limited = within_limits
                             ? std::min(known, unknownEnergy(until))  // after a pause, the assumed one may be less
                             : std::max(known, 0.0);                  // a jump takes no energy
  energy_ += limited;
  const double fastest =
      interval_ > 0.0 ? farthest / interval_ + options_.max_acceleration * interval_ : options_.max_speed;
  speed_ = std::min(options_.max_speed, fastest);
  known_ = until;
  held_.reset();
}

double PassivityController::limit(double wanted, SteadyTime now) {
  if (!known_) return 0.0;
  forget(wanted, now);
  if (!held_) held_ = steadyEffort(now);
  const double bound = std::min(*held_, maxEffort(now, toSeconds(options_.period)));
  const double effort = std::clamp(wanted, -bound, bound);
  remember(effort, now);
  return effort;
}

void PassivityController::forget(double wanted, SteadyTime now) {
  if (wanted != 0.0) return free_.reset();
  if (!free_) free_ = now;
  cycle_ = 0.0;
  energy_ = now - *free_ < kForgiven ? std::max(energy_, 0.0) : 0.0;
}

// Returns the largest displacement of the hand within a time [s] after the newest known position.
double PassivityController::maxDisplacement(double after) const {
  const double speeds_up = std::min(after, (options_.max_speed - speed_) / options_.max_acceleration);
  return speed_ * speeds_up + options_.max_acceleration * speeds_up * speeds_up / 2 +
         options_.max_speed * (after - speeds_up);
}

// Returns the largest effort that may be sent for a duration [s].
double PassivityController::maxEffort(SteadyTime now, double duration) const {
  const double left = tolerance() - energy_ - unknownEnergy(now);
  const double ends = seconds(now) + duration + toSeconds(options_.output_delay);
  return std::max(0.0, left) / (maxDisplacement(ends) - maxDisplacement(seconds(now)));
}

// Returns the largest effort that could have been sent since the newest position, and can be until the next one.
double PassivityController::steadyEffort(SteadyTime now) {
  cycle_ = std::max(kKept * cycle_, seconds(now) + (interval_ < kPause ? interval_ : 0.0));
  const double ends = cycle_ + toSeconds(options_.period + options_.output_delay);
  const double tail = toSeconds(options_.output_delay) * options_.max_speed;
  return std::max(0.0, tolerance() - energy_) / (maxDisplacement(ends) + tail);
}

// Integrates the largest |effort| that may act, times the largest speed. An increase may act at once; a decrease may act
// only after the delay of the output.
double PassivityController::unknownEnergy(SteadyTime now) const {
  const double output_delay = toSeconds(options_.output_delay);
  double energy = 0.0;
  double newer = 0.0;
  double increases = 0.0;
  visitActing(SteadyTime::max(), [&](const Sent& sent, SteadyTime next) {
    const double effort = std::abs(sent.value);
    const double from = std::max(0.0, seconds(sent.stamp));
    energy += effort * (maxDisplacement(std::max(from, seconds(std::min(next, now)))) - maxDisplacement(from));
    increases += std::max(0.0, newer - effort);
    newer = effort;
  });
  const double last = maxDisplacement(seconds(now) + output_delay) - maxDisplacement(seconds(now));
  return energy + (increases + newer) * last;
}

// An effort that leaves the ring before the motion under it is known is charged with the worst case.
void PassivityController::remember(double effort, SteadyTime now) {
  if (count_ == kCapacity) {
    const Sent& oldest = before(kCapacity - 1);
    const SteadyTime ended = before(kCapacity - 2).stamp + options_.output_delay;
    if (ended > *known_) energy_ += std::abs(oldest.value) * options_.max_speed * toSeconds(ended - oldest.stamp);
  }
  ring_[next_] = {now, effort};
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

}  // namespace sweep_guard_core
