#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sweep_guard_core {

/// Numbers, and what most of them are.
class Sample {
 public:
  void add(double value) { values_.push_back(value); }
  size_t count() const { return values_.size(); }
  const std::vector<double>& values() const { return values_; }

  /// @param fraction  in [0, 1]; 0.5: the median
  double quantile(double fraction) const {
    std::vector<double> values = values_;
    const auto middle = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + middle, values.end());
    return values[static_cast<size_t>(middle)];
  }

  double mean() const {
    double sum = 0.0;
    for (const double value : values_) sum += value;
    return sum / static_cast<double>(values_.size());
  }

 private:
  std::vector<double> values_;
};

}  // namespace sweep_guard_core
