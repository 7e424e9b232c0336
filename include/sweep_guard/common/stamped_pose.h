#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// The pose of the tool frame T in the fixed frame W at one time.
struct StampedPose {
  Time stamp;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< rotation orthonormal, translation [m]
};

}  // namespace sweep_guard_core
