#include "sweep_guard/haptics/passivity_controller.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_core {
namespace {

constexpr double kPause = 0.06;                      // between positions that do not come one after the other [s]
constexpr double kKept = 0.995;                      // of the longest cycle, with each position
constexpr double kRounding = 1e-9;                   // relative, of a way
constexpr auto kForgiven = std::chrono::seconds(1);  // without a wanted force until what was given is forgotten

}  // namespace

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

void PassivityController::moved(double displacement, SteadyTime until, double doubt) {
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
  interval_ = seconds(until);
  const double way = std::abs(displacement) + doubt;
  const double deviation = options_.max_acceleration * interval_ * interval_ / 2;
  const double path = std::max(way, std::min(options_.max_speed * interval_, way + deviation));
  const double middle = (lowest + highest) / 2;
  const double known = middle * displacement + std::abs(middle) * doubt + (highest - lowest) / 2 * path;
  const bool within_limits = way - 2.0 * doubt <= (1.0 + kRounding) * longestWay(interval_);
  const double limited = within_limits
                             ? std::min(known, unknownEnergy(until))  // after a pause, the assumed one may be less
                             : std::max(known, 0.0);                  // a jump takes no energy
  energy_ += limited;
  const double fastest = interval_ > 0.0 ? way / interval_ + options_.max_acceleration * interval_ : options_.max_speed;
  speed_ = std::min(options_.max_speed, fastest);
  known_ = until;
  held_.reset();
}

double PassivityController::limit(double wanted, SteadyTime now) {
  if (!known_) return 0.0;
  forget(wanted, now);
  if (!held_) held_ = steady(now);
  const double bound = std::min(*held_, most(now, toSeconds(options_.period)));
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

// Returns the longest way of the hand so long after the newest known position.
double PassivityController::longestWay(double after) const {
  const double speeds_up = std::min(after, (options_.max_speed - speed_) / options_.max_acceleration);
  return speed_ * speeds_up + options_.max_acceleration * speeds_up * speeds_up / 2 +
         options_.max_speed * (after - speeds_up);
}

// Returns the largest effort that may be sent for so long [s].
double PassivityController::most(SteadyTime now, double lasts) const {
  const double left = tolerance() - energy_ - unknownEnergy(now);
  const double ends = seconds(now) + lasts + toSeconds(options_.output_delay);
  return std::max(0.0, left) / (longestWay(ends) - longestWay(seconds(now)));
}

// Returns the largest effort that could have been sent all the time, and until the next position.
double PassivityController::steady(SteadyTime now) {
  cycle_ = std::max(kKept * cycle_, seconds(now) + (interval_ < kPause ? interval_ : 0.0));
  const double ends = cycle_ + toSeconds(options_.period + options_.output_delay);
  const double tail = toSeconds(options_.output_delay) * options_.max_speed;
  return std::max(0.0, tolerance() - energy_) / (longestWay(ends) + tail);
}

// The integral of the largest |effort| that may act, times the speed: each increase may come as late, and each decrease as
// much later, as the output takes.
double PassivityController::unknownEnergy(SteadyTime now) const {
  const double output_delay = toSeconds(options_.output_delay);
  double energy = 0.0;
  double newer = 0.0;
  double increases = 0.0;
  visitActing(SteadyTime::max(), [&](const Sent& sent, SteadyTime next) {
    const double effort = std::abs(sent.effort);
    const double from = std::max(0.0, seconds(sent.at));
    energy += effort * (longestWay(std::max(from, seconds(std::min(next, now)))) - longestWay(from));
    increases += std::max(0.0, newer - effort);
    newer = effort;
  });
  const double last = longestWay(seconds(now) + output_delay) - longestWay(seconds(now));
  return energy + (increases + newer) * last;
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
