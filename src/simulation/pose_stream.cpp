#include "simulation/pose_stream.h"

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

sweep_guard_core::Time stampOf(long sample, double rate) {
  return sweep_guard_core::Time(sweep_guard_core::fromSeconds(static_cast<double>(sample) / rate));
}

}  // namespace

Replay::Replay(std::vector<StampedPose> motion, const Options& options)
    : playback_(moved(std::move(motion), options), options.loop) {}

PoseStream sampled(const Drilling& drilling, double rate, bool loop) {
  return [drilling, rate, loop, sample = 0L]() mutable -> std::optional<StampedPose> {
    const double t = static_cast<double>(sample) / rate;
    if (!loop && t > drilling.duration()) return std::nullopt;
    return StampedPose{stampOf(sample++, rate), drilling.pose(t)};
  };
}

PoseStream replayed(std::vector<StampedPose> poses, const Replay::Options& options) {
  return [replay = Replay(std::move(poses), options)]() mutable { return replay.next(); };
}

PoseStream guided(const GuidedTip& tip, double rate, Guide guide) {
  return
      [moving = GuidedTip(tip), rate, guide = std::move(guide), sample = 0L]() mutable -> std::optional<StampedPose> {
        if (sample > 0) guide(moving, 1.0 / rate);
        return StampedPose{stampOf(sample++, rate), moving.pose()};
      };
}

}  // namespace sweep_guard_simulation
