#pragma once

#include <ros/steady_timer.h>

#include "guard/workpiece_store.h"
#include "ros/clock_watch.h"
#include "ros/output/warning_publisher.h"
#include "sweep_guard/monitor/warning_monitor.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// Publishes warning and flags periodically, even if the inputs are silent, and watches the clocks: if time goes back (a
/// bag loops, a simulation restarts) or the machine was suspended, the stamps from before are meaningless. Has its own
/// thread.
class Watchdog {
 public:
  Watchdog(const ros::NodeHandle& node, sweep_guard_core::WarningMonitor& monitor,
           sweep_guard_core::WorkpieceStore& workpieces, WarningPublisher& warnings);

  void start() { thread_.start(); }

 private:
  void checkClock();

  sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::WorkpieceStore& workpieces_;
  WarningPublisher& warnings_;
  ClockWatch clocks_;
  QueueThread thread_;  // before the timers, which use its queue
  ros::SteadyTimer timer_;
  ros::SteadyTimer reflex_timer_;
  ros::SteadyTimer considered_timer_;
};

}  // namespace sweep_guard_ros
