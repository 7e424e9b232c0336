#pragma once

#include <Eigen/Geometry>

namespace sweep_guard_core {

/// Returns the smallest rotation that takes the direction `from` to the direction `to`, of any lengths but 0. Between opposite
/// directions its axis is arbitrary. Each source that calls Eigen's FromTwoVectors() compiles an SVD of its own.
Eigen::Quaterniond rotationBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace sweep_guard_core
