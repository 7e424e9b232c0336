#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_simulation {

/// When the poses of a motion are due. What a stall of the machine held up is made up for, pose by pose, unless a hand
/// leads the motion: that goes on from now, as the hand never led what was missed.
class PoseScheduler {
 public:
  static constexpr sweep_guard_core::Duration kStall = std::chrono::milliseconds(100);  ///< what is later has stalled

  /// @param live  a hand leads the motion
  PoseScheduler(sweep_guard_core::Time start, bool live) : start_(start), live_(live) {}

  /// @param stamp  of the pose, counted from the start of the motion (0)
  sweep_guard_core::Time due(sweep_guard_core::Time stamp) const { return start_ + stamp.time_since_epoch(); }

  /// To be called when a pose goes out. After a stall of a live motion this pose is due now, and those that follow are
  /// put off by as much.
  /// @return whether that is so
  bool resume(sweep_guard_core::Time stamp, sweep_guard_core::Time now);

 private:
  sweep_guard_core::Time start_;
  bool live_;
};

}  // namespace sweep_guard_simulation
