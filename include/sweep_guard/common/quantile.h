#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sweep_guard_core {

/// Returns the value below which a fraction of the sample lies, interpolated linearly between neighbors as by numpy's
/// `quantile`; NaN for an empty sample.
/// @param sample    without NaN
/// @param fraction  in [0, 1]; not checked
inline double quantile(std::vector<double> sample, double fraction) {
  if (sample.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double rank = fraction * static_cast<double>(sample.size() - 1);
  const auto lower = sample.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sample.begin(), lower, sample.end());
  const double share = rank - std::floor(rank);
  if (share == 0.0) return *lower;
  return (1.0 - share) * *lower + share * *std::min_element(lower + 1, sample.end());
}

}  // namespace sweep_guard_core
