#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Returns the time so long after the epoch.
inline Time atSecond(double seconds) { return Time(fromSeconds(seconds)); }

/// Returns the time that is so many milliseconds later than a second after the epoch.
inline Time at(int ms) { return Time(std::chrono::milliseconds(1000 + ms)); }

}  // namespace sweep_guard_core
