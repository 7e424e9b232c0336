#pragma once

#include <cmath>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

/// A tool that points along x (its tip first) and is at x = speed * t; a pose every `period` from 0 to `length`.
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
