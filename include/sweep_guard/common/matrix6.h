#pragma once

#include <Eigen/Core>

namespace sweep_guard_core {

/// Holds a translation [m], then a rotation vector [rad], or their rates [m/s], [rad/s]. The user names the axes.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// Holds a covariance of such values, in this order.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

}  // namespace sweep_guard_core
