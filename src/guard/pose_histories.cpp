#include "guard/pose_histories.h"

#include <utility>

#include "guard/frame_jumps.h"

namespace sweep_guard_core {

void PoseHistories::add(const PoseWithFrames& pose, const BodyPose& body, const FrameMotions& frames) {
  ++poses_;
  const auto goes_to = [&](const std::string& frame) { return !pose.anew || pose.anew->concerns(frame); };
  const bool begins = pose.anew && !pose.anew->goes_on;
  for (const auto& [frame, X_WM] : pose.X_WM) {
    if (frames.count(frame) != 0 || !goes_to(frame)) continue;
    joined_.erase(frame);
    histories_[frame].add({poses_, pose.stamp, body.X_WB, X_WM, body.deviation_bound, begins});
  }
  for (const auto& [frame, motion] : frames) {
    if (goes_to(frame) && !joined_[frame].add(pose.stamp, body, begins)) passed_over_.insert(frame);
  }
}

// Numbers ascend in each history, also where several samples lie between two poses.
void PoseHistories::join(const FrameMotions& frames) {
  for (const auto& [frame, motion] : frames) {
    joined_[frame].join(*motion, samples_);
    for (PoseSample& sample : samples_) {
      sample.number = ++poses_;
      histories_[frame].add(sample);
      if (sample.left_out) passed_over_.insert(frame);
    }
  }
}

bool PoseHistories::isPlaced(const std::string& frame, const PoseWithFrames& pose, const FrameMotions& frames) const {
  return (frames.count(frame) != 0 || pose.X_WM.count(frame) != 0) && histories_.count(frame) != 0;
}

const PoseHistory* PoseHistories::find(const std::string& frame) const {
  const auto history = histories_.find(frame);
  return history == histories_.end() ? nullptr : &history->second;
}

void PoseHistories::findJumps(std::uint64_t after, const SpeedLimits& limits,
                              std::map<std::string, JumpSpeed>& jumps) const {
  jumps.clear();
  for (const auto& [frame, history] : histories_) {
    if (const auto speed = jumpAfter(after, history, limits)) jumps.emplace(frame, *speed);
  }
}

std::set<std::string> PoseHistories::takePassedOver() { return std::exchange(passed_over_, {}); }

void PoseHistories::forgetOtherFrames(const Workpieces& workpieces) {
  keepOnlyNamed(workpieces, &Workpiece::frame, histories_);
  keepOnlyNamed(workpieces, &Workpiece::frame, joined_);
}

void PoseHistories::reset() {
  histories_.clear();
  joined_.clear();
  passed_over_.clear();
}

}  // namespace sweep_guard_core
