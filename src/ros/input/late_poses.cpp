#include "ros/input/late_poses.h"

#include <chrono>
#include <utility>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::QueuedPose;

constexpr size_t kMaxWaitingPoses = 8192;  // poses
constexpr size_t kMaxToolFrames = 16;      // made-up names take no room from others

}  // namespace

void LatePoses::use(const std::string& frame) {
  if (used_.count(frame) != 0) return;
  if (used_.size() == kMaxToolFrames) used_.clear();
  used_.insert(frame);
  frames_.use("tool", live_.initial().fixed_frame, used_);
}

std::optional<QueuedPose> LatePoses::locate(const ReceivedPose& pose) {
  std::optional<QueuedPose> located;
  if (waiting_.empty()) located = locate(pose, pose.timestamps.received);
  if (!located) waiting_.push_back(pose);
  return located;
}

std::optional<QueuedPose> LatePoses::locateNext() {
  if (waiting_.empty()) return std::nullopt;
  ReceivedPose next = std::move(waiting_.front());
  waiting_.pop_front();
  auto located = locate(next, std::chrono::steady_clock::now());
  if (!located) waiting_.push_front(std::move(next));
  return located;
}

std::optional<QueuedPose> LatePoses::locate(const ReceivedPose& pose, sweep_guard_core::SteadyTime known) {
  const auto X_WF = find(pose.frame, pose.timestamps.stamp, pose.timestamps.received);
  if (!X_WF) return std::nullopt;
  located_ = pose.timestamps.stamp;
  frame_ = pose.frame;
  return QueuedPose{{pose.timestamps.stamp, known, *X_WF * pose.X_FT}, pose.checkpoint};
}

std::optional<Eigen::Isometry3d> LatePoses::locateToolFrame(sweep_guard_core::Time stamp) {
  const std::string& tool_frame = live_.initial().tool_frame;
  const sweep_guard_core::SteadyTime since = joints_wait_since_.value_or(std::chrono::steady_clock::now());
  joints_wait_since_.reset();
  auto X_WT = find(tool_frame, stamp, since);
  if (!X_WT) joints_wait_since_ = since;
  if (X_WT) frame_ = tool_frame;
  return X_WT;
}

// Returns nothing while the transform may still come. It may have come after the first look, and nobody tells of it again.
std::optional<Eigen::Isometry3d> LatePoses::find(const std::string& frame, sweep_guard_core::Time stamp,
                                                 sweep_guard_core::SteadyTime since) {
  const std::string& fixed_frame = live_.initial().fixed_frame;
  for (const bool waits : {false, true}) {
    if (waits) has_begun_to_wait_ = true;
    // Read first: the lookup finds a transform that comes after this.
    const auto newest = frames_.newest(fixed_frame, frame);
    try {
      return frames_.lookup(fixed_frame, frame, stamp);
    } catch (const FrameError& error) {
      if (!newest || *newest >= stamp) throw;
      if (std::chrono::steady_clock::now() - since > live_.get()->limits.pose_timeout)
        throw FrameError(std::string(error.what()) + ": it has not come within timing/pose_timeout");
    }
  }
  return std::nullopt;
}

bool LatePoses::leaveOutIfFull() {
  if (waiting_.size() <= kMaxWaitingPoses) return false;
  waiting_.erase(waiting_.begin() + 1);
  return true;
}

std::optional<sweep_guard_core::Time> LatePoses::newest() const {
  return waiting_.empty() ? located_ : waiting_.back().timestamps.stamp;
}

void LatePoses::clear() {
  waiting_.clear();
  joints_wait_since_.reset();
  located_.reset();
}

}  // namespace sweep_guard_ros
