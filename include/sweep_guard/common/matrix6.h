#pragma once

#include <Eigen/Core>

namespace sweep_guard_core {

/// Vector and matrix over the six degrees of freedom of a rigid body: translation, then rotation vector.
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

}  // namespace sweep_guard_core
