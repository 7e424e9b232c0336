#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace sweep_guard_ros {

/// Returns whether a transform of a part of a mesh file flattens it: the volume of a transformed cube is at most a millionth
/// of the product of its edges. Also true if a number is NaN.
/// @param linear  the transform without its translation
inline bool isSingular(const Eigen::Matrix3d& linear) {
  return !(std::abs(linear.determinant()) > 1e-6 * linear.colwise().norm().prod());
}

}  // namespace sweep_guard_ros
