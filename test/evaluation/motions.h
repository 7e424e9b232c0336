#pragma once

#include <cmath>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_evaluation {

using std::chrono::milliseconds;
using std::chrono::seconds;
using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

/// Returns a motion along x with the tip ahead, at x = speed * t, with a pose every `period` from 0 to `length`.
inline std::vector<StampedPose> straightMotion(double speed, sweep_guard_core::Duration period,
                                               sweep_guard_core::Duration length) {
  std::vector<StampedPose> poses;
  for (sweep_guard_core::Duration time{0}; time <= length; time += period) {
    StampedPose pose;
    pose.stamp = Time(time);
    pose.X_WT.translation().x() = speed * sweep_guard_core::toSeconds(time);
    pose.X_WT.linear() = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitY()).toRotationMatrix();
    poses.push_back(pose);
  }
  return poses;
}

/// Returns a motion along a figure of eight, 0.4 m wide, for a minute.
inline std::vector<StampedPose> winding() {
  std::vector<StampedPose> poses = straightMotion(0.0, milliseconds(20), seconds(60));
  for (StampedPose& pose : poses) {
    const double t = sweep_guard_core::toSeconds(pose.stamp.time_since_epoch());
    pose.X_WT.translation() << 0.2 * std::sin(0.9 * t), 0.2 * std::sin(1.7 * t), 0.1 * std::cos(0.6 * t);
    pose.X_WT.rotate(Eigen::AngleAxisd(0.5 * std::sin(t), Eigen::Vector3d::UnitX()));
  }
  return poses;
}

}  // namespace sweep_guard_evaluation
