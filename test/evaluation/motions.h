#pragma once

#include <cmath>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

/// Returns a motion along x with the tip ahead, at x = speed * t, with a pose every `period` from 0 to `length`.
inline std::vector<sweep_guard_core::StampedPose> straightMotion(double speed, sweep_guard_core::Duration period,
                                                                 sweep_guard_core::Duration length) {
  std::vector<sweep_guard_core::StampedPose> poses;
  for (sweep_guard_core::Duration time{0}; time <= length; time += period) {
    sweep_guard_core::StampedPose pose;
    pose.stamp = sweep_guard_core::Time(time);
    pose.X_WT.translation().x() = speed * sweep_guard_core::toSeconds(time);
    pose.X_WT.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()).toRotationMatrix();
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace sweep_guard_evaluation
