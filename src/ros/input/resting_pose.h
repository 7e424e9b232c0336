#pragma once

#include <atomic>

#include "ros/input/frames.h"
#include "ros/parameters/live_parameters.h"

namespace sweep_guard_ros {

/// Knows whether a tool from tf is at rest, and when to ask for it.
class RestingPose {
 public:
  /// Both must outlive this.
  RestingPose(const LiveParameters& live, const Frames& frames) : live_(live), frames_(frames) {}

  /// Returns whether to ask rests() now: timing/min_rate times a second at least, by either clock, and no more often. Looks nothing
  /// up. One thread.
  bool isDue(const sweep_guard_core::Instant& now);

  /// Returns whether a newest transform of the tool is a pose by itself. Not one of stamp 0, and not while transforms lie ahead of now by up to 1 s
  /// and the tool stays until then: its poses are those of now, see rests(). If it moves, they may be of a fast clock, and its pose of
  /// now late by that. One thread.
  bool moves(sweep_guard_core::Time newest);

  /// Returns whether the tool is placed at a stamp, and no transform moves it, or none until its newest if that lies ahead. Any thread.
  /// @throws sweep_guard_core::InvalidInput if nothing can ever move it, or what does has no stamps
  bool rests(sweep_guard_core::Time stamp) const;

 private:
  bool stays(sweep_guard_core::Time begin, sweep_guard_core::Time end) const;

  const LiveParameters& live_;
  const Frames& frames_;
  sweep_guard_core::Instant asked_{};      // when it was last due
  std::atomic<bool> stays_ahead_ = false;  // its transforms lie ahead
};

}  // namespace sweep_guard_ros
