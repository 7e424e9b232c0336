#pragma once

#include <Eigen/Geometry>

namespace sweep_guard_core {

/// Returns the smallest rotation that takes the direction `from` to `to`, of any lengths but 0; of the half turns between opposite
/// directions, any. Each source that calls Eigen's own takes a third longer to compile.
Eigen::Quaterniond rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace sweep_guard_core
