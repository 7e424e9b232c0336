#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Holds the times when the sender stamped an input and when it was received.
struct Timestamps {
  Time stamp;
  SteadyTime received;
};

/// Returns the age on the clock on which it is larger. A missing stamp counts as the clock's epoch.
Duration age(const Timestamps& input, const Instant& now);

/// Returns whether the age exceeds `timeout`; Duration::max() never times out.
bool stale(const Timestamps& input, const Instant& now, Duration timeout);

}  // namespace sweep_guard_core
