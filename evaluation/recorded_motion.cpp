#include "evaluation/recorded_motion.h"

#include <algorithm>
#include <cassert>

#include "sweep_guard/common/quantile.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::StampedPose;
using sweep_guard_core::Time;

namespace {

constexpr Duration kMinGap = std::chrono::milliseconds(250);
constexpr int kPeriodsOfGap = 3;

std::vector<StampedPose> lastOfEachStamp(const std::vector<StampedPose>& poses) {
  std::vector<StampedPose> kept;
  kept.reserve(poses.size());
  for (const StampedPose& pose : poses) {
    if (!kept.empty() && kept.back().stamp == pose.stamp) kept.pop_back();
    kept.push_back(pose);
  }
  return kept;
}

Duration longestPeriod(const std::vector<StampedPose>& poses) {
  if (poses.size() < 2) return kMinGap;
  std::vector<double> periods;
  for (size_t i = 1; i < poses.size(); ++i) {
    periods.push_back(sweep_guard_core::toSeconds(poses[i].stamp - poses[i - 1].stamp));
  }
  return std::max(kMinGap, sweep_guard_core::fromSeconds(kPeriodsOfGap * sweep_guard_core::quantile(periods, 0.5)));
}

bool isEarlier(Time time, const StampedPose& pose) { return time < pose.stamp; }

}  // namespace

RecordedMotion::RecordedMotion(const std::vector<StampedPose>& poses) : poses_(lastOfEachStamp(poses)) {
  assert(!poses_.empty());
  const Duration longest = longestPeriod(poses_);
  for (const StampedPose& pose : poses_) {
    if (segments_.empty() || pose.stamp - segments_.back().end > longest) segments_.push_back({pose.stamp, {}});
    segments_.back().end = pose.stamp;
  }
}

bool RecordedMotion::isContinuous(Time from, Time to) const {
  const auto after = std::upper_bound(
      segments_.begin(), segments_.end(), from,
      [](Time time, const sweep_guard_recording::TimeInterval& segment) { return time < segment.begin; });
  return after != segments_.begin() && to <= std::prev(after)->end;
}

size_t RecordedMotion::newestAt(Time time) const {
  assert(time >= poses_.front().stamp);
  return static_cast<size_t>(std::upper_bound(poses_.begin(), poses_.end(), time, isEarlier) - poses_.begin()) - 1;
}

Eigen::Isometry3d RecordedMotion::at(Time time) const {
  assert(time <= poses_.back().stamp);
  const size_t before = newestAt(time);
  const StampedPose& from = poses_[before];
  if (from.stamp == time) return from.X_WT;
  const StampedPose& to = poses_[before + 1];
  const double fraction =
      sweep_guard_core::toSeconds(time - from.stamp) / sweep_guard_core::toSeconds(to.stamp - from.stamp);
  return sweep_guard_core::Motion{from.X_WT, to.X_WT}.at(fraction);
}

}  // namespace sweep_guard_evaluation
