#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

/// Returns the pose X_WC of a camera whose optical axis goes through a point; x of its picture is level [m].
/// @throws sweep_guard_core::InvalidInput if one is above the other, as along z of W
inline Eigen::Isometry3d lookingAt(const Eigen::Vector3d& target_W, const Eigen::Vector3d& position_W) {
  const Eigen::Vector3d z_W = (target_W - position_W).normalized();
  const Eigen::Vector3d x_W = z_W.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << x_W, z_W.cross(x_W), z_W;
  X_WC.translation() = position_W;
  if (!X_WC.linear().isUnitary(1e-6))
    throw sweep_guard_core::InvalidInput("a camera must not be above or below what it looks at");
  return X_WC;
}

}  // namespace sweep_guard_simulation
