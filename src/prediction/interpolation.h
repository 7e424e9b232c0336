#pragma once

#include <algorithm>

#include "prediction/delayed_targets.h"

namespace sweep_guard_core {

/// Interpolates linearly in time between values at kLearnedHorizons; before the first and after the last, the value is
/// constant.
/// @param ahead  [s]
/// @param at     called as at(i); returns the value at kLearnedHorizons[i]
template <typename Value, typename At>
Value interpolateOverHorizons(double ahead, At&& at) {
  const auto upper = std::lower_bound(kLearnedHorizons.begin(), kLearnedHorizons.end(), ahead);
  if (upper == kLearnedHorizons.begin()) return at(0);
  if (upper == kLearnedHorizons.end()) return at(kLearnedHorizons.size() - 1);
  const auto i = static_cast<size_t>(upper - kLearnedHorizons.begin());
  const double share = (ahead - kLearnedHorizons[i - 1]) / (kLearnedHorizons[i] - kLearnedHorizons[i - 1]);
  return (1.0 - share) * at(i - 1) + share * at(i);
}

}  // namespace sweep_guard_core
