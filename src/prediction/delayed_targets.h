#pragma once

#include <array>
#include <boost/circular_buffer.hpp>

#include "prediction/displacement.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// How far ahead [s] predictors learn; between these they interpolate.
constexpr std::array<double, 8> kLearnedHorizons = {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0};

/// Keeps what was known at every pose until it shows how far the tool really went from there within each of
/// kLearnedHorizons.
template <typename Known>
class DelayedTargets {
 public:
  /// Tells what has come true with the newest pose, and keeps what is known at it.
  /// @param on_target  called as on_target(known, i, displacement) for kLearnedHorizons[i] after the pose it was known at
  template <typename OnTarget>
  void add(const StampedPose& newest, const Known& known, OnTarget&& on_target) {
    for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
      for (; next_[i] < moments_.size(); ++next_[i]) {
        const Moment& moment = moments_[next_[i]];
        const Time then = moment.pose.stamp + fromSeconds(kLearnedHorizons[i]);
        if (then > newest.stamp) break;
        on_target(moment.known, i, displacement(moment.pose.X_WT, between(moments_.back().pose, newest, then)));
      }
    }
    dropSettled();
    if (moments_.full()) moments_.set_capacity(2 * moments_.capacity());
    moments_.push_back({newest, known});
  }

  /// The newest pose was wrong.
  void correctNewest(const StampedPose& pose, const Known& known) {
    if (!moments_.empty()) moments_.back() = {pose, known};
  }

  /// The motion has been interrupted: what has not come true will not be known.
  void clear() {
    moments_.clear();
    next_.fill(0);
  }

 private:
  struct Moment {
    StampedPose pose;
    Known known;
  };

  static Eigen::Isometry3d between(const StampedPose& from, const StampedPose& to, Time stamp) {
    const double share = toSeconds(stamp - from.stamp) / toSeconds(to.stamp - from.stamp);
    return displaced(from.X_WT, share * displacement(from.X_WT, to.X_WT));
  }

  void dropSettled() {
    const size_t settled = next_.back();
    moments_.erase_begin(settled);
    for (size_t& next : next_) next -= settled;
  }

  boost::circular_buffer<Moment> moments_{64};
  std::array<size_t, kLearnedHorizons.size()> next_{};  // first moment that has not come true that far ahead
};

}  // namespace sweep_guard_core
