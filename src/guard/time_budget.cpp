#include "guard/time_budget.h"

#include <algorithm>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr double kDecay = 0.98;      // per cycle: half in 35 cycles
constexpr double kFirstGuess = 2.5;  // measured sweeps; near a workpiece its probability is computed, too
constexpr double kPlanned = 0.75;    // of the cycle: the next cycle may cost more

}  // namespace

TimeBudget::TimeBudget(const HorizonOptions& horizon, Duration cycle) : horizon_(horizon), cycle_(cycle) {
  check(horizon_);
  if (cycle_ <= Duration::zero()) throw InvalidInput("cycle: must be > 0 s");
}

size_t TimeBudget::consideredSweeps(size_t reflex_volumes, size_t considered_volumes, size_t bodies) const {
  const double per_volume = per_volume_.value_or(kFirstGuess * measured_);
  const double left = toSeconds(forPrediction()) - static_cast<double>(reflex_volumes) * per_volume;
  const size_t most = sweep_guard_core::consideredSweeps(horizon_);
  if (left >= static_cast<double>(considered_volumes) * per_volume) return most;
  return static_cast<size_t>(
      std::clamp(left / per_volume / static_cast<double>(bodies), 1.0, static_cast<double>(most)));
}

Duration TimeBudget::forPrediction() const {
  return fromSeconds(std::max(0.0, kPlanned * toSeconds(cycle_) - measured_));
}

void TimeBudget::spentOnMeasured(Duration time) { measured_ = std::max(toSeconds(time), kDecay * measured_); }

void TimeBudget::spentOnPredicted(Duration time, size_t volumes) {
  if (volumes == 0) return;
  const double per_volume = toSeconds(time) / static_cast<double>(volumes);
  per_volume_ = std::max(per_volume, kDecay * per_volume_.value_or(0.0));
}

}  // namespace sweep_guard_core
