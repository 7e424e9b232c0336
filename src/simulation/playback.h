#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// Plays recorded samples, each at its interval from the one before. Keeps samples with equal stamps.
/// @tparam Sample  has a `stamp`
template <typename Sample>
class Playback {
 public:
  /// @param samples  stamps not decreasing
  /// @param loop     at the end plays backwards, then forwards again, without a jump; false: plays once
  /// @throws sweep_guard_core::InvalidInput if there are no samples, or if they last no time and shall loop
  Playback(std::vector<Sample> samples, bool loop) : samples_(std::move(samples)), loop_(loop) {
    if (samples_.empty()) throw sweep_guard_core::InvalidInput("the motion is empty: give one with samples");
    if (loop_ && samples_.front().stamp == samples_.back().stamp) {
      throw sweep_guard_core::InvalidInput("the motion lasts no time and cannot loop; set loop to false");
    }
  }

  /// Returns the next sample, with its stamp counted from the first one (0); empty after the last one.
  std::optional<Sample> next() {
    if (index_ == samples_.size()) {
      if (!loop_) return std::nullopt;
      std::reverse(samples_.begin(), samples_.end());
      index_ = 1;
    }
    Sample sample = samples_[index_];
    if (index_ > 0) stamp_ += std::chrono::abs(sample.stamp - samples_[index_ - 1].stamp);
    ++index_;
    sample.stamp = stamp_;
    return sample;
  }

 private:
  std::vector<Sample> samples_;
  bool loop_;
  std::size_t index_ = 0;
  sweep_guard_core::Time stamp_;
};

}  // namespace sweep_guard_simulation
