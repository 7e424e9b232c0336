#pragma once

#include <algorithm>

#include "prediction/delayed_targets.h"

namespace sweep_guard_core {

/// A value between those of kLearnedHorizons, linear in time; beyond the first and the last of them it stays.
/// @param ahead  [s]
/// @param at     the value at kLearnedHorizons[i], called as at(i)
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
