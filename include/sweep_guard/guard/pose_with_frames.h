#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// The pose of the tool frame T, and of every mesh frame M, in the fixed frame W at one moment. All poses must
/// be finite, with orthonormal rotations (not checked).
struct PoseWithFrames {
  Time stamp;
  SteadyTime received;                                     ///< when the pose arrived
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< translation [m]
  std::map<std::string, Eigen::Isometry3d> X_WM;  ///< [m], by name of M; a frame whose transform is missing is left out
  /// Bound [m], >= 0, on the distance of a tool point, at any time since the previous pose, from where it would be if the tool
  /// moved as Motion says: of a tool that joints move.
  double deviation_bound = 0.0;
};

}  // namespace sweep_guard_core
