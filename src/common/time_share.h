#pragma once

#include <algorithm>
#include <chrono>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Limits a repeated task to a share of the time. What it leaves unused is kept for it, and what it takes too much is
/// owed, up to a limit.
class TimeShare {
 public:
  /// @param share  of the time, in (0, 1)
  /// @param kept   time of the past whose share may still be used, and time that may still be owed
  TimeShare(double share, Duration kept) : share_(share), kept_(kept) {}

  /// Returns when the task may run again.
  SteadyTime due() const { return due_; }

  void spend(Duration took, SteadyTime end) {
    const auto interval = std::chrono::duration_cast<Duration>(took / share_);
    const SteadyTime begin = end - took;
    due_ = std::clamp(due_, begin - kept_, begin + kept_) + interval;
    after_ = due_ + interval;
  }

  /// Returns when the task may run once more after the next time, if that takes as long as the newest.
  SteadyTime dueAfterNext() const { return after_; }

 private:
  double share_;
  Duration kept_;
  SteadyTime due_;
  SteadyTime after_;
};

}  // namespace sweep_guard_core
