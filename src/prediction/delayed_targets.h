#pragma once

#include <array>
#include <boost/circular_buffer.hpp>

#include "prediction/displacement.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Horizons [s] for which predictors learn; they interpolate between these.
constexpr std::array<double, 8> kLearnedHorizons = {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0};

/// Keeps the features of every pose until the displacement of the tool within each of kLearnedHorizons is known.
template <typename Features>
class DelayedTargets {
 public:
  /// Reports the targets that the newest pose completes, and keeps its features.
  /// @param on_target  called as on_target(features, i, displacement): features of an earlier pose, and the
  ///                   displacement from that pose within kLearnedHorizons[i]
  template <typename OnTarget>
  void add(const StampedPose& newest, const Features& features, OnTarget&& on_target) {
    for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
      for (; next_[i] < samples_.size(); ++next_[i]) {
        const Sample& sample = samples_[next_[i]];
        const Time then = sample.pose.stamp + fromSeconds(kLearnedHorizons[i]);
        if (then > newest.stamp) break;
        on_target(sample.features, i, displacement(sample.pose.X_WT, between(samples_.back().pose, newest, then)));
      }
    }
    dropCompleted();
    if (samples_.full()) samples_.set_capacity(2 * samples_.capacity());
    samples_.push_back({newest, features});
  }

  /// Replaces the newest pose and its features.
  void correctNewest(const StampedPose& pose, const Features& features) {
    if (!samples_.empty()) samples_.back() = {pose, features};
  }

  /// Forgets all poses: after an interruption their targets are never completed.
  void clear() {
    samples_.clear();
    next_.fill(0);
  }

 private:
  struct Sample {
    StampedPose pose;
    Features features;
  };

  static Eigen::Isometry3d between(const StampedPose& from, const StampedPose& to, Time stamp) {
    const double share = toSeconds(stamp - from.stamp) / toSeconds(to.stamp - from.stamp);
    return displaced(from.X_WT, share * displacement(from.X_WT, to.X_WT));
  }

  void dropCompleted() {
    const size_t completed = next_.back();
    samples_.erase_begin(completed);
    for (size_t& next : next_) next -= completed;
  }

  boost::circular_buffer<Sample> samples_{64};
  std::array<size_t, kLearnedHorizons.size()> next_{};  // first sample whose target for this horizon is open
};

}  // namespace sweep_guard_core
