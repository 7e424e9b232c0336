#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Keeps by how much the newest intervals between ticks differed from the period. Any thread.
class TickRecord {
 public:
  explicit TickRecord(sweep_guard_core::Duration period) : period_(period) {}

  void tick(sweep_guard_core::SteadyTime now) {
    const sweep_guard_core::Lock lock(mutex_);
    if (ticked_) jitter_[count_++ % kTicks] = std::abs(sweep_guard_core::toSeconds(now - *ticked_ - period_));
    ticked_ = now;
  }

  /// Returns these differences [s], at least one.
  std::vector<double> jitter() const {
    std::vector<double> jitter;
    jitter.reserve(kTicks);
    const sweep_guard_core::Lock lock(mutex_);
    jitter.assign(jitter_.begin(),
                  jitter_.begin() + static_cast<std::ptrdiff_t>(std::clamp<size_t>(count_, 1, kTicks)));
    return jitter;
  }

 private:
  static constexpr size_t kTicks = 1000;

  const sweep_guard_core::Duration period_;
  mutable sweep_guard_core::Mutex mutex_;
  std::optional<sweep_guard_core::SteadyTime> ticked_ GUARDED_BY(mutex_);
  std::array<double, kTicks> jitter_ GUARDED_BY(mutex_){};
  size_t count_ GUARDED_BY(mutex_) = 0;
};

}  // namespace sweep_guard_ros
