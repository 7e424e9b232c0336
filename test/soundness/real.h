#pragma once

#include <Eigen/Geometry>

namespace sweep_guard_core::soundness {

/// Number type of the checks: 64 bits of mantissa, eleven more than double.
using Real = long double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;

}  // namespace sweep_guard_core::soundness
