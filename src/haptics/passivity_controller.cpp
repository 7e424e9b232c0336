#include "sweep_guard/haptics/passivity_controller.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_core {

double PassivityController::tolerance() const {
  return options_.max_effort * options_.max_speed * toSeconds(options_.period);
}

// Visits, from the newest one on, what may have acted between the newest known position and `until`. Before the oldest one
// that is remembered, nothing acted, or it is charged already.
template <typename Visit>
void PassivityController::visitActing(SteadyTime until, const Visit& visit) const {
  SteadyTime next = SteadyTime::max();
  for (size_t i = 0; i < count_; ++i) {
    const Sent& sent = before(i);
    if (next != SteadyTime::max() && next + options_.output_delay <= *known_) return;
    if (sent.at < until) visit(sent, std::min(next, until));
    next = sent.at;
  }
  if (*known_ < next) visit(Sent{0.0, *known_}, std::min(next, until));
}

void PassivityController::moved(double displacement, SteadyTime until) {
  if (!known_) known_ = until;
  until = std::max(until, *known_);
  double lowest = 0.0;
  double highest = 0.0;
  bool first = true;
  visitActing(until, [&](const Sent& sent, SteadyTime /*next*/) {
    lowest = first ? sent.effort : std::min(lowest, sent.effort);
    highest = first ? sent.effort : std::max(highest, sent.effort);
    first = false;
  });
  const double way = std::max(std::abs(displacement), options_.max_speed * toSeconds(until - *known_));
  energy_ += (lowest + highest) / 2 * displacement + (highest - lowest) / 2 * way;
  known_ = until;
}

double PassivityController::limit(double wanted, SteadyTime now) {
  if (!known_) return 0.0;
  if (wanted == 0.0) energy_ = std::max(energy_, 0.0);
  const double left = tolerance() - energy_ - unknownEnergy(now);
  const double way = options_.max_speed * toSeconds(options_.period + options_.output_delay);
  const double most = std::max(0.0, left) / way;
  const double effort = std::clamp(wanted, -most, most);
  remember(effort, now);
  return effort;
}

// The integral of the largest |effort| that may act, times the speed: each increase may come as late, and each decrease as
// much later, as the output takes.
double PassivityController::unknownEnergy(SteadyTime now) const {
  double impulse = 0.0;
  double newer = 0.0;
  double increases = 0.0;
  visitActing(SteadyTime::max(), [&](const Sent& sent, SteadyTime next) {
    const double effort = std::abs(sent.effort);
    const Duration acts = std::min(next, now) - std::max(sent.at, *known_);
    impulse += effort * std::max(0.0, toSeconds(acts));
    increases += std::max(0.0, newer - effort);
    newer = effort;
  });
  return options_.max_speed * (impulse + (increases + newer) * toSeconds(options_.output_delay));
}

// What is forgotten before it is known how the device moved is charged as the worst.
void PassivityController::remember(double effort, SteadyTime now) {
  if (count_ == kCapacity) {
    const Sent& oldest = before(kCapacity - 1);
    const SteadyTime ended = before(kCapacity - 2).at + options_.output_delay;
    if (ended > *known_) energy_ += std::abs(oldest.effort) * options_.max_speed * toSeconds(ended - oldest.at);
  }
  ring_[next_] = {effort, now};
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

}  // namespace sweep_guard_core
