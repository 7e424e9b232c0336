#pragma once

#include <Eigen/Core>
#include <vector>

namespace sweep_guard_core {

/// Linear functions f(p) = gradient · p + constant of a point, of which the largest is found on the processor's vector
/// units: of the corners of a hull the support function, of its faces the signed distance.
class LinearFunctions {
 public:
  void add(const Eigen::Vector3d& gradient, double constant);
  bool empty() const { return size_ == 0; }

  /// Returns the index, in the order of add(), of a function that is largest at `p`, up to rounding. There must be one
  /// (asserted).
  size_t largest(const Eigen::Vector3d& p) const;

  Eigen::Vector3d gradient(size_t i) const { return {x_[i], y_[i], z_[i]}; }
  double value(size_t i, const Eigen::Vector3d& p) const { return gradient(i).dot(p) + constant_[i]; }

 private:
  size_t size_ = 0;
  std::vector<double> x_;  // filled up with copies of the last one
  std::vector<double> y_;
  std::vector<double> z_;
  std::vector<double> constant_;
};

}  // namespace sweep_guard_core
