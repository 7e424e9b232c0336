#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Returns a duration of so many seconds; of more than it can hold, which is 292 years, the longest.
inline sweep_guard_core::Duration toDuration(double seconds) {
  constexpr double kLongest = 9e9;  // [s]
  return seconds > kLongest ? sweep_guard_core::Duration::max() : sweep_guard_core::fromSeconds(seconds);
}

}  // namespace sweep_guard_ros
