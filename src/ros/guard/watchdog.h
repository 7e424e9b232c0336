#pragma once

#include <functional>

#include "guard/workpiece_store.h"
#include "monitor/clock_watch.h"
#include "ros/input/frames.h"
#include "ros/output/warning_publisher.h"
#include "ros/threads/timer_thread.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Publishes warning and flags periodically, even if the inputs are silent, and watches the clocks: if time goes back (a
/// bag loops, a simulation restarts) or the machine was suspended, the stamps from before are meaningless. Has its own
/// thread.
class Watchdog {
 public:
  /// @param often  called every 10 ms
  Watchdog(Frames& frames, sweep_guard_core::WorkpieceStore& workpieces, sweep_guard_core::WarningMonitor& monitor,
           WarningPublisher& warnings, const std::function<void()>& often);

  void start(Supervisor& supervisor) { thread_.start(supervisor, {"warnings", sweep_guard_core::Stage::kMonitor}); }

 private:
  void checkClock();

  Frames& frames_;
  sweep_guard_core::WorkpieceStore& workpieces_;
  sweep_guard_core::WarningMonitor& monitor_;
  WarningPublisher& warnings_;
  sweep_guard_core::ClockWatch clocks_;
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
