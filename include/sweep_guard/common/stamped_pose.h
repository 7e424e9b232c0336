#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Holds a translation [m], then a rotation vector [rad], or their rates [m/s], [rad/s]. The user names the axes.
using Vector6d = Eigen::Matrix<double, 6, 1>;
/// Holds a covariance of such values, in this order.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A value at one time, of either clock.
template <typename Value, typename Stamp = Time>
struct StampedValue {
  Stamp stamp;
  Value value;
};

/// The pose of the tool frame T in the fixed frame W at one time.
struct StampedPose {
  Time stamp;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< rotation orthonormal, translation [m]
};

}  // namespace sweep_guard_core
