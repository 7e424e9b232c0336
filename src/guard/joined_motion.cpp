#include "guard/joined_motion.h"

#include <algorithm>

#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

Eigen::Isometry3d between(Time from, const Eigen::Isometry3d& X_from, Time to, const Eigen::Isometry3d& X_to,
                          Time time) {
  if (time >= to) return X_to;
  if (time <= from) return X_from;
  return Motion{X_from, X_to}.at(toSeconds(time - from) / toSeconds(to - from));
}

}  // namespace

void JoinedMotion::join(const FrameMotion& frame, std::vector<Sample>& samples) {
  samples.clear();
  if (body_.size() == 0 || (!frame_ && !begin(frame, samples))) return;
  const auto is_after = [](Time time, const FramePose& pose) { return time < pose.stamp; };
  auto next = std::upper_bound(frame.measured.begin(), frame.measured.end(), frame_->stamp, is_after);
  while (body_.size() > 1 && next != frame.measured.end()) {
    const Time time = std::min(body_[1].stamp, next->stamp);
    samples.push_back(at(time, *next));
    if (body_[1].stamp == time) body_.forgetFirst();
    if (next->stamp == time) frame_ = *next++;
  }
}

// Returns false if no time is known of both.
bool JoinedMotion::begin(const FrameMotion& frame, std::vector<Sample>& samples) {
  const auto& measured = frame.measured;
  const Time time = std::max(body_[0].stamp, measured.front().stamp);
  if (time > body_.newest().stamp || time > measured.back().stamp) return false;
  while (body_.size() > 1 && body_[1].stamp <= time) body_.forgetFirst();
  size_t i = 0;
  while (i + 1 < measured.size() && measured[i + 1].stamp <= time) ++i;
  frame_ = measured[i];
  samples.push_back(at(time, measured[std::min(i + 1, measured.size() - 1)]));
  return true;
}

JoinedMotion::Sample JoinedMotion::at(Time time, const FramePose& next) const {
  const Pose& from = body_[0];
  const Pose& to = body_[std::min<size_t>(1, body_.size() - 1)];
  return {time, between(from.stamp, from.body.X_WB, to.stamp, to.body.X_WB, time),
          between(frame_->stamp, frame_->X_WM, next.stamp, next.X_WM, time),
          to.body.deviation_bound + next.deviation_bound};
}

}  // namespace sweep_guard_core
