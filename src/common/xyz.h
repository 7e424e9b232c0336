#pragma once

#include <Eigen/Core>
#include <array>

namespace sweep_guard_core {

/// Returns the coordinates of a point for a range-based loop, which Eigen's own vectors lack before version 3.4.
template <typename Point>
std::array<typename Point::Scalar, 3> xyz(const Eigen::MatrixBase<Point>& point) {
  return {point[0], point[1], point[2]};
}

}  // namespace sweep_guard_core
