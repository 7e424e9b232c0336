#pragma once

#include <Eigen/Core>

namespace sweep_guard_core {

/// Holds six values of a rigid body: translation [m], then rotation vector [rad]; the user names the axes.
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

}  // namespace sweep_guard_core
