#pragma once

#include <cmath>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

/// A tool that points along x (its tip first) and is at x = speed * t; a pose every `period` from 0 to `length`.
inline std::vector<sweep_guard::StampedPose> straightMotion(double speed, sweep_guard::Duration period,
                                                            sweep_guard::Duration length) {
  std::vector<sweep_guard::StampedPose> poses;
  for (sweep_guard::Duration time{0}; time <= length; time += period) {
    sweep_guard::StampedPose pose;
    pose.stamp = sweep_guard::Time(time);
    pose.X_WT.translation().x() = speed * sweep_guard::toSeconds(time);
    pose.X_WT.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()).toRotationMatrix();
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace sweep_guard_evaluation
