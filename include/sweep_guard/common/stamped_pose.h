#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Where the tool frame T was at a moment, in the fixed frame W.
struct StampedPose {
  Time stamp;
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< rotation orthonormal, translation [m]
};

}  // namespace sweep_guard_core
