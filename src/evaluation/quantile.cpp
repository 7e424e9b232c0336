#include "evaluation/quantile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace sweep_guard_evaluation {

double quantile(std::vector<double> sample, double fraction) {
  assert(fraction >= 0.0 && fraction <= 1.0);
  if (sample.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = fraction * static_cast<double>(sample.size() - 1);
  const auto below = sample.begin() + static_cast<std::ptrdiff_t>(std::floor(place));
  std::nth_element(sample.begin(), below, sample.end());
  const double share = place - std::floor(place);
  if (share == 0.0) return *below;
  return (1.0 - share) * *below + share * *std::min_element(below + 1, sample.end());
}

}  // namespace sweep_guard_evaluation
