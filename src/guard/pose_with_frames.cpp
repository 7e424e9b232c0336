#include "sweep_guard/guard/pose_with_frames.h"

#include <algorithm>

namespace sweep_guard_core {

double FrameDrift::displacement(double radius) const {
  return toSeconds(age) * (velocity_W.head<3>().norm() + radius * velocity_W.tail<3>().norm());
}

void assign(PoseWithFrames& to, const PoseWithFrames& from) {
  const auto same_frame = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (!std::equal(to.X_WM.begin(), to.X_WM.end(), from.X_WM.begin(), from.X_WM.end(), same_frame)) {
    to = from;
    return;
  }
  to.stamp = from.stamp;
  to.received = from.received;
  to.X_WT = from.X_WT;
  to.bodies = from.bodies;
  to.state = from.state;
  to.jump = from.jump;
  to.anew = from.anew;
  to.drifts = from.drifts;
  auto next = from.X_WM.begin();
  for (auto& [frame, X_WM] : to.X_WM) X_WM = next++->second;
}

void placeFollowed(const FrameMotions& frames, PoseWithFrames& pose) {
  for (const auto& [frame, motion] : frames) {
    pose.X_WM.erase(frame);
    pose.drifts.erase(frame);
    const auto placed = motion->at(pose.stamp);
    if (!placed) continue;
    pose.X_WM[frame] = placed->X_WM;
    if (!motion->goes_on) continue;
    const Duration age = std::max(pose.stamp - motion->measured.back().stamp, Duration::zero());
    pose.drifts[frame] = {motion->velocity(), age};
  }
}

}  // namespace sweep_guard_core
