#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// Schedules the poses of a motion. After a stall of the machine, a recorded or scripted motion catches up pose by
/// pose; a live motion continues from now, because the operator never made the missed motion.
class PoseScheduler {
 public:
  static constexpr sweep_guard_core::Duration kStall = std::chrono::milliseconds(100);  ///< a longer delay is a stall

  /// @param live  an operator guides the motion
  PoseScheduler(sweep_guard_core::Time start, bool live) : start_(start), live_(live) {}

  /// Returns when a pose is due.
  /// @param stamp  of the pose, counted from the start of the motion (0)
  sweep_guard_core::Time due(sweep_guard_core::Time stamp) const { return start_ + stamp.time_since_epoch(); }

  /// Reports that a pose is published at `now`. After a stall of a live motion, this pose becomes due now and later
  /// poses are delayed by the same time.
  /// @return whether there was such a stall
  bool resume(sweep_guard_core::Time stamp, sweep_guard_core::Time now) {
    const sweep_guard_core::Duration delay = now - due(stamp);
    if (!live_ || delay <= kStall) return false;
    start_ += delay;
    return true;
  }

 private:
  sweep_guard_core::Time start_;
  bool live_;
};

}  // namespace sweep_guard_simulation
