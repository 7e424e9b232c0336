#include "sweep_guard/haptics/coning_bound.h"

#include <algorithm>
#include <cmath>

namespace sweep_guard_core {

double coningBound(double angle, double interval, const TurnLimits& limits) {
  const double longest = limits.max_rate * interval;
  if (longest + angle >= 2.0 * M_PI) return longest + angle;
  const double length = std::max(angle, std::min(longest, angle + limits.max_acceleration * interval * interval / 2.0));
  const double rate = interval > 0.0 ? std::min(limits.max_rate, angle / interval + limits.max_acceleration * interval)
                                     : limits.max_rate;
  const double area =
      std::min(rate * limits.max_acceleration * interval * interval * interval / 12.0, length * length / (2.0 * M_PI));
  return (1.0 + length / 2.0) * area;
}

}  // namespace sweep_guard_core
