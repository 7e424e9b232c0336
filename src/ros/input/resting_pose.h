#pragma once

#include "ros/input/frames.h"
#include "ros/parameters/parameters.h"

namespace sweep_guard_ros {

/// Knows whether a tool from tf is at rest, and when to ask for it.
class RestingPose {
 public:
  /// Both must outlive this.
  RestingPose(const LiveParameters& live, const Frames& frames) : live_(live), frames_(frames) {}

  /// Returns whether to ask rests() now: timing/min_rate times a second at least, by either clock, and no more often. Looks nothing
  /// up. One thread.
  bool isDue(const sweep_guard_core::Instant& now);

  /// Returns whether the tool is placed at a stamp and no transform moves it. Any thread.
  /// @throws sweep_guard_core::InvalidInput if nothing can ever move it, or what does has no stamps
  bool rests(sweep_guard_core::Time stamp) const;

 private:
  const LiveParameters& live_;
  const Frames& frames_;
  sweep_guard_core::Instant asked_{};  // when it was last due
};

}  // namespace sweep_guard_ros
