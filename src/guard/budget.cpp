#include "sweep_guard/guard/budget.h"

#include <algorithm>

#include "sweep_guard/common/error.h"

namespace sweep_guard {
namespace {

constexpr double kFall = 0.98;       // per cycle: half in 35 of them
constexpr double kFirstGuess = 2.5;  // measured sweeps; near a workpiece its probability is looked for, too
constexpr double kPlanned = 0.75;    // of the cycle: the next one may cost more

}  // namespace

Budget::Budget(const HorizonOptions& horizon, Duration cycle) : horizon_(horizon), cycle_(cycle) {
  check(horizon_);
  if (cycle_ <= Duration::zero()) throw InvalidInput("cycle: must be > 0 s");
}

size_t Budget::consideredSweeps(size_t reflex_sweeps) const {
  const double per_sweep = per_sweep_.value_or(kFirstGuess * measured_);
  const double left = kPlanned * toSeconds(cycle_) - measured_ - static_cast<double>(reflex_sweeps) * per_sweep;
  const size_t most = sweep_guard::consideredSweeps(horizon_);
  if (left >= static_cast<double>(most) * per_sweep) return most;
  return static_cast<size_t>(std::max(1.0, left / per_sweep));
}

void Budget::spentOnMeasured(Duration time) { measured_ = std::max(toSeconds(time), kFall * measured_); }

void Budget::spentOnPredicted(Duration time, size_t sweeps) {
  if (sweeps == 0) return;
  const double per_sweep = toSeconds(time) / static_cast<double>(sweeps);
  per_sweep_ = std::max(per_sweep, kFall * per_sweep_.value_or(0.0));
}

}  // namespace sweep_guard
