#pragma once

#include <functional>

#include "monitor/clock_watch.h"
#include "ros/guard/guard_state.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Publishes warning and flags periodically, even if the inputs are silent, and watches the clocks: if time goes back (a
/// bag loops, a simulation restarts) or the machine was suspended, the stamps from before are meaningless. Has its own
/// thread.
class Watchdog {
 public:
  /// @param often  called every 10 ms
  Watchdog(GuardState& state, const std::function<void()>& often);

  void start() { thread_.start(state_.supervisor, {"warnings", sweep_guard_core::Stage::kMonitor}); }

 private:
  void checkClock();

  GuardState& state_;
  sweep_guard_core::ClockWatch clocks_;
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
