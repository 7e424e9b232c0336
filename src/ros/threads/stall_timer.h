#pragma once

#include <cstdint>
#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// What the kernel knows about a thread.
struct ThreadState {
  enum class Activity {
    kRunnable,  ///< runs, or waits for a processor
    kBlocked,   ///< waits for something else
    kStopped,   ///< stopped from outside, or unknown
  };
  sweep_guard_core::Duration processor_time;  ///< since its start
  Activity activity;
};

/// Measures for how long a thread has worked without a step, in its own time: processor time that it took, and time that
/// it was blocked while the checks came in time. So a thread or a process that is stopped, or gets no processor, does not
/// stall.
class StallTimer {
 public:
  /// @param steps       of the thread; empty: it has no work
  /// @param since_last  time since the last check; what exceeds 20 ms counts as a stop of the checking thread
  /// @param starving    another thread waits for a processor: this one may be blocked by it
  void check(const std::optional<std::uint64_t>& steps, const ThreadState& state, sweep_guard_core::Duration since_last,
             bool starving);
  /// Returns whether the thread waits for a processor since the last check.
  bool starves(const std::optional<std::uint64_t>& steps, const ThreadState& state) const;

  sweep_guard_core::Duration stalled() const { return stalled_; }  ///< 0: it has made a step, or has no work

 private:
  std::optional<std::uint64_t> steps_;  // as of the last check, like those below
  sweep_guard_core::Duration processor_time_{};
  sweep_guard_core::Duration stalled_{};
};

}  // namespace sweep_guard_ros
