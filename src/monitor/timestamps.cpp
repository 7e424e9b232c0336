#include "sweep_guard/monitor/timestamps.h"

#include <algorithm>

namespace sweep_guard_core {

Duration age(const Timestamps& input, const Instant& now) {
  return std::max(now.stamp - input.stamp, now.steady - input.received);
}

bool stale(const Timestamps& input, const Instant& now, Duration timeout) {
  return timeout != Duration::max() && age(input, now) > timeout;
}

}  // namespace sweep_guard_core
