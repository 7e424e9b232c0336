#include "simulation/replay.h"

#include <utility>

namespace sweep_guard_simulation {

using sweep_guard_core::StampedPose;

namespace {

Eigen::Vector3d lowestTip(const std::vector<StampedPose>& motion, sweep_guard_core::Duration window) {
  Eigen::Vector3d lowest = motion.front().X_WT.translation();
  for (const StampedPose& pose : motion) {
    if (pose.stamp - motion.front().stamp > window) break;
    if (pose.X_WT.translation().z() < lowest.z()) lowest = pose.X_WT.translation();
  }
  return lowest;
}

std::vector<StampedPose> moved(std::vector<StampedPose> motion, const Replay::Options& options) {
  if (motion.empty()) return motion;
  const Eigen::Vector3d shift = options.target_W - lowestTip(motion, options.window);
  for (StampedPose& pose : motion) pose.X_WT.pretranslate(shift);
  return motion;
}

}  // namespace

Replay::Replay(std::vector<StampedPose> motion, const Options& options)
    : playback_(moved(std::move(motion), options), options.loop) {}

}  // namespace sweep_guard_simulation
