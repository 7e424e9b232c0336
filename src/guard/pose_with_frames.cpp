#include "sweep_guard/guard/pose_with_frames.h"

#include <algorithm>

namespace sweep_guard_core {

double FrameDrift::displacement(double radius) const {
  return toSeconds(age) * (velocity_W.head<3>().norm() + radius * velocity_W.tail<3>().norm());
}

void placeFollowed(const FrameMotions& frames, PoseWithFrames& pose) {
  for (const auto& [frame, motion] : frames) {
    pose.X_WM.erase(frame);
    pose.drifts.erase(frame);
    const auto placed = motion->at(pose.stamp);
    if (!placed) continue;
    pose.X_WM[frame] = placed->X_WT;
    if (!motion->goes_on) continue;
    const Duration age = std::max(pose.stamp - motion->measured.back().stamp, Duration::zero());
    pose.drifts[frame] = {motion->velocity(), age};
  }
}

}  // namespace sweep_guard_core
