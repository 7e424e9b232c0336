#pragma once

#include <vector>

namespace sweep_guard_evaluation {

/// The value below which a fraction of the sample lies; between two values of the sorted sample it is interpolated
/// linearly (as numpy's `quantile` does). NaN of an empty sample.
/// @param fraction  in [0, 1]
double quantile(std::vector<double> sample, double fraction);

}  // namespace sweep_guard_evaluation
