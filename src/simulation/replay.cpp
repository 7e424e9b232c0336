#include "simulation/replay.h"

#include <algorithm>
#include <utility>

#include "sweep_guard/common/error.h"

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

}  // namespace

Replay::Replay(std::vector<StampedPose> motion, const Options& options)
    : motion_(std::move(motion)), loop_(options.loop) {
  if (motion_.empty()) throw sweep_guard_core::InvalidInput("the motion has no poses");
  if (loop_ && motion_.front().stamp == motion_.back().stamp) {
    throw sweep_guard_core::InvalidInput("the motion lasts no time and cannot loop; set loop to false");
  }
  const Eigen::Vector3d shift = options.target_W - lowestTip(motion_, options.window);
  for (StampedPose& pose : motion_) pose.X_WT.pretranslate(shift);
}

std::optional<StampedPose> Replay::next() {
  if (index_ == motion_.size()) {
    if (!loop_) return std::nullopt;
    std::reverse(motion_.begin(), motion_.end());
    index_ = 1;
  }
  const StampedPose& pose = motion_[index_];
  if (index_ > 0) stamp_ += std::chrono::abs(pose.stamp - motion_[index_ - 1].stamp);
  ++index_;
  return StampedPose{stamp_, pose.X_WT};
}

}  // namespace sweep_guard_simulation
