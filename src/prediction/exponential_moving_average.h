#pragma once

#include <cmath>

namespace sweep_guard_core {

constexpr double kAveragingTime =
    20.0;  ///< [s] time constant with which the past fades from what is learned of an operator

/// What is left after a while of the weight of what was before.
/// @param period  [s], >= 0
inline double decay(double period) { return std::exp(-period / kAveragingTime); }

/// Mean over the recent past, weighted by time.
template <typename Value>
class ExponentialMovingAverage {
 public:
  /// @param prior  the mean before anything has been added
  /// @param weight [s] it takes so much time to outweigh it, > 0
  explicit ExponentialMovingAverage(const Value& prior, double weight = 1e-3) : sum_(weight * prior), weight_(weight) {}

  /// @param period  that the value stands for [s], >= 0
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
