#pragma once

#include <algorithm>

#include "sweep_guard/prediction/hindsight.h"

namespace sweep_guard {

/// A value between those of kLearnedAhead, linear in time; beyond the first and the last of them it stays.
/// @param ahead  [s]
/// @param at     the value at kLearnedAhead[i], called as at(i)
template <typename Value, typename At>
Value overLearnedAhead(double ahead, At&& at) {
  const auto upper = std::lower_bound(kLearnedAhead.begin(), kLearnedAhead.end(), ahead);
  if (upper == kLearnedAhead.begin()) return at(0);
  if (upper == kLearnedAhead.end()) return at(kLearnedAhead.size() - 1);
  const auto i = static_cast<size_t>(upper - kLearnedAhead.begin());
  const double share = (ahead - kLearnedAhead[i - 1]) / (kLearnedAhead[i] - kLearnedAhead[i - 1]);
  return (1.0 - share) * at(i - 1) + share * at(i);
}

}  // namespace sweep_guard
