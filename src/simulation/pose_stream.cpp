#include "simulation/pose_stream.h"

#include <utility>

namespace sweep_guard_simulation {

using sweep_guard_core::StampedPose;

namespace {

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
