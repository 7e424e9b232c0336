#include "simulation/pose_stream.h"

#include <chrono>
#include <utility>

#include "simulation/playback.h"

namespace sweep_guard_simulation {

using sweep_guard_core::StampedPose;

namespace {

constexpr sweep_guard_core::Duration kWindow = std::chrono::seconds(5);  // from the first pose

Eigen::Vector3d lowestTip(const std::vector<StampedPose>& motion) {
  Eigen::Vector3d lowest = motion.front().X_WT.translation();
  for (const StampedPose& pose : motion) {
    if (pose.stamp - motion.front().stamp > kWindow) break;
    if (pose.X_WT.translation().z() < lowest.z()) lowest = pose.X_WT.translation();
  }
  return lowest;
}

std::vector<StampedPose> moved(std::vector<StampedPose> motion, const Eigen::Vector3d& target_W) {
  if (motion.empty()) return motion;
  const Eigen::Vector3d shift = target_W - lowestTip(motion);
  for (StampedPose& pose : motion) pose.X_WT.pretranslate(shift);
  return motion;
}

sweep_guard_core::Time stampOf(long sample, double rate) {
  return sweep_guard_core::Time(sweep_guard_core::fromSeconds(static_cast<double>(sample) / rate));
}

}  // namespace

PoseStream sampled(const Drilling& drilling, double rate, bool loop) {
  return [drilling, rate, loop, sample = 0L]() mutable -> std::optional<StampedPose> {
    const double t = static_cast<double>(sample) / rate;
    if (!loop && t > drilling.duration()) return std::nullopt;
    return StampedPose{stampOf(sample++, rate), drilling.pose(t)};
  };
}

PoseStream replayed(std::vector<StampedPose> motion, bool loop, const Eigen::Vector3d& target_W) {
  return [playback = Playback(moved(std::move(motion), target_W), loop)]() mutable { return playback.next(); };
}

PoseStream guided(const GuidedTip& tip, double rate, Guide guide) {
  return
      [moving = GuidedTip(tip), rate, guide = std::move(guide), sample = 0L]() mutable -> std::optional<StampedPose> {
        if (sample > 0) guide(moving, 1.0 / rate);
        return StampedPose{stampOf(sample++, rate), moving.pose()};
      };
}

}  // namespace sweep_guard_simulation
