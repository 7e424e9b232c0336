#pragma once

#include <chrono>

#include "sweep_guard/guard/guard_options.h"

namespace sweep_guard_evaluation {

constexpr sweep_guard_core::Duration kWatchdogPeriod = std::chrono::milliseconds(10);  ///< of the node's watchdog
constexpr const char* kFrame = "world";                                                ///< of poses and obstacles

/// Returns a time of the recording on both clocks.
inline sweep_guard_core::Instant instantOf(sweep_guard_core::Time time) {
  return {time, sweep_guard_core::SteadyTime(time.time_since_epoch())};
}

/// Returns the options of a guard whose time budget never runs out.
inline sweep_guard_core::GuardOptions withoutTimeLimit(sweep_guard_core::GuardOptions options) {
  options.clock = [] { return sweep_guard_core::SteadyTime(); };
  return options;
}

}  // namespace sweep_guard_evaluation
