#include "sweep_guard/geometry/linear_functions.h"

#include <algorithm>
#include <cassert>

#include "sweep_guard/simd/kernels.h"

namespace sweep_guard_core {

void LinearFunctions::add(const Eigen::Vector3d& gradient, double constant) {
  const size_t padded = (size_ + simd::kFunctions) / simd::kFunctions * simd::kFunctions;
  const auto append = [&](std::vector<double>& values, double value) {
    values.resize(size_);
    values.resize(padded, value);
  };
  append(x_, gradient.x());
  append(y_, gradient.y());
  append(z_, gradient.z());
  append(constant_, constant);
  ++size_;
}

size_t LinearFunctions::largest(const Eigen::Vector3d& p) const {
  assert(!empty());
  static const auto find = simd::kernels().largest;
  const size_t found = find({x_.data(), y_.data(), z_.data(), constant_.data(), x_.size()}, {p.x(), p.y(), p.z()});
  return std::min(found, size_ - 1);
}

}  // namespace sweep_guard_core
