#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

inline constexpr SteadyTime steadyAt(int ms) { return SteadyTime(std::chrono::milliseconds(ms)); }

/// Returns the instant that is so many milliseconds later than 100 s on both clocks.
inline constexpr Instant at(int ms) { return {Time(std::chrono::milliseconds(100'000 + ms)), steadyAt(100'000 + ms)}; }
inline constexpr Timestamps received(int ms) { return {at(ms).stamp, at(ms).steady}; }

}  // namespace sweep_guard_core
