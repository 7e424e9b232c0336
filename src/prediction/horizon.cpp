#include "sweep_guard/prediction/horizon.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr Duration::rep kMaxSweeps = 10000;

void checkStep(const std::string& key, Duration interval, Duration step) {
  if (step <= Duration::zero()) throw InvalidInput("horizon " + key + ": must be > 0 s");
  if (interval / step >= kMaxSweeps) {
    throw InvalidInput("horizon " + key + ": takes more than 10000 sweeps; choose a longer step");
  }
}

size_t steps(Duration interval, Duration step) { return static_cast<size_t>((interval + step - Duration(1)) / step); }

// Appends whole nanoseconds; the last end is exactly `to`.
void appendEqual(std::vector<Duration>& ends, Duration from, Duration to, size_t count) {
  for (size_t i = 1; i <= count; ++i) {
    const auto [quotient, rest] = std::div((to - from).count(), static_cast<std::int64_t>(count));
    const auto k = static_cast<std::int64_t>(i);
    ends.push_back(from + Duration(quotient * k + rest * k / static_cast<std::int64_t>(count)));
  }
}

}  // namespace

void check(const HorizonOptions& options) {
  if (options.reflex <= Duration::zero()) throw InvalidInput("horizon reflex: must be > 0 s");
  if (options.considered <= options.reflex) throw InvalidInput("horizon considered: must be longer than reflex");
  if (options.reserve < Duration::zero()) throw InvalidInput("horizon reserve: must be >= 0 s");
  checkStep("reflex_step", options.reflex + options.reserve, options.reflex_step);
  checkStep("considered_step", options.considered + options.reserve, options.considered_step);
}

size_t reflexSweeps(const HorizonOptions& options, Duration age) {
  assert(age >= Duration::zero());
  return steps(std::min(age, options.reserve) + options.reflex, options.reflex_step);
}

size_t consideredSweeps(const HorizonOptions& options) {
  return steps(options.considered + options.reserve - options.reflex, options.considered_step);
}

void computeHorizon(const HorizonOptions& options, Duration age, Horizon& horizon) {
  horizon.ends.clear();
  horizon.reflex_sweeps = reflexSweeps(options, age);
  const Duration reflex_end = age + options.reflex;
  appendEqual(horizon.ends, Duration::zero(), reflex_end, horizon.reflex_sweeps);
  appendEqual(horizon.ends, reflex_end, age + options.considered + options.reserve, consideredSweeps(options));
}

Horizon horizonUpTo(Duration end, HorizonOptions options, Duration age) {
  assert(end > Duration::zero());
  options.considered = std::max(end, options.reflex + options.considered_step);
  Horizon horizon;
  computeHorizon(options, age, horizon);
  while (!horizon.ends.empty() && horizon.ends.back() >= age + end) horizon.ends.pop_back();
  horizon.ends.push_back(age + end);
  horizon.reflex_sweeps = std::min(horizon.reflex_sweeps, horizon.ends.size());
  return horizon;
}

}  // namespace sweep_guard_core
