#pragma once

#include <algorithm>
#include <array>
#include <boost/circular_buffer.hpp>

#include "prediction/motion_space.h"

namespace sweep_guard_core {

/// Horizons [s] for which predictors learn; they interpolate between these.
constexpr std::array<double, 8> kLearnedHorizons = {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0};

/// Keeps the features of every sample until the displacement within each of kLearnedHorizons is known.
template <typename Space, typename Features>
class DelayedTargets {
 public:
  using Sample = typename Space::Sample;

  /// Reports the targets that the newest sample completes, and keeps its features.
  /// @param on_target  called as on_target(features, i, displacement): features of an earlier sample, and the
  ///                   displacement from that sample within kLearnedHorizons[i]
  template <typename OnTarget>
  void add(const Sample& newest, const Features& features, OnTarget&& on_target) {
    for (size_t i = 0; i < kLearnedHorizons.size(); ++i) {
      for (; next_[i] < samples_.size(); ++next_[i]) {
        const Kept& kept = samples_[next_[i]];
        const Time then = kept.sample.stamp + fromSeconds(kLearnedHorizons[i]);
        if (then > newest.stamp) break;
        on_target(kept.features, i, Space::displacementOf(kept.sample, between(samples_.back().sample, newest, then)));
      }
    }
    dropCompleted();
    if (samples_.full()) samples_.set_capacity(2 * samples_.capacity());
    samples_.push_back({newest, features});
  }

  /// Replaces the newest sample and its features.
  void correctNewest(const Sample& sample, const Features& features) {
    if (!samples_.empty()) samples_.back() = {sample, features};
  }

  /// Forgets all samples: after an interruption their targets are never completed.
  void clear() {
    samples_.clear();
    next_.fill(0);
  }

 private:
  struct Kept {
    Sample sample;
    Features features;
  };

  static Sample between(const Sample& from, const Sample& to, Time stamp) {
    const double share = toSeconds(stamp - from.stamp) / toSeconds(to.stamp - from.stamp);
    return Space::displacedSample(from, share * Space::displacementOf(from, to));
  }

  void dropCompleted() {
    const size_t completed = next_.back();
    samples_.erase_begin(completed);
    for (size_t& next : next_) next -= completed;
  }

  boost::circular_buffer<Kept> samples_{64};
  std::array<size_t, kLearnedHorizons.size()> next_{};  // first sample whose target for this horizon is open
};

/// Interpolates linearly in time between values at kLearnedHorizons; before the first and after the last, the value is
/// constant.
/// @param ahead  [s]
/// @param at     called as at(i); returns the value at kLearnedHorizons[i]
template <typename Value, typename At>
Value interpolateOverHorizons(double ahead, At&& at) {
  const auto upper = std::lower_bound(kLearnedHorizons.begin(), kLearnedHorizons.end(), ahead);
  if (upper == kLearnedHorizons.begin()) return at(0);
  if (upper == kLearnedHorizons.end()) return at(kLearnedHorizons.size() - 1);
  const auto i = static_cast<size_t>(upper - kLearnedHorizons.begin());
  const double share = (ahead - kLearnedHorizons[i - 1]) / (kLearnedHorizons[i] - kLearnedHorizons[i - 1]);
  return (1.0 - share) * at(i - 1) + share * at(i);
}

}  // namespace sweep_guard_core
