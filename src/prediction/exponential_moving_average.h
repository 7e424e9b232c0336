#pragma once

#include <cmath>

namespace sweep_guard_core {

/// Time constant [s] with which older observations of an operator lose weight.
constexpr double kAveragingTime = 20.0;

/// Returns the factor by which older observations lose weight within a period.
/// @param period  [s], >= 0
inline double decay(double period) { return std::exp(-period / kAveragingTime); }

/// Computes an exponential moving average, weighted by time.
template <typename Value>
class ExponentialMovingAverage {
 public:
  /// @param prior   mean before any value is added
  /// @param weight  time that outweighs the prior [s], > 0
  explicit ExponentialMovingAverage(const Value& prior, double weight = 1e-3) : sum_(weight * prior), weight_(weight) {}

  /// @param period  time that the value represents [s], >= 0
  void add(const Value& value, double period) {
    sum_ = decay(period) * sum_ + period * value;
    weight_ = decay(period) * weight_ + period;
  }

  Value mean() const { return sum_ / weight_; }

 private:
  Value sum_;
  double weight_;
};

}  // namespace sweep_guard_core
