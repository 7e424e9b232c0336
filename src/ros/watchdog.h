#pragma once

#include <ros/steady_timer.h>

#include "ros/input/workpiece_store.h"
#include "ros/output/warning_publisher.h"
#include "sweep_guard/monitor/warning_monitor.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// Steady timers that warn and repeat the flags whatever the inputs do, and watch the clock of the stamps: when it goes
/// back (a bag that loops, a simulation that starts again), every stamp of before is meaningless. Its own thread.
class Watchdog {
 public:
  Watchdog(const ros::NodeHandle& node, sweep_guard_core::WarningMonitor& monitor, WorkpieceStore& workpieces,
           WarningPublisher& warnings);

  void start() { thread_.start(); }

 private:
  void watchClock();

  sweep_guard_core::WarningMonitor& monitor_;
  WorkpieceStore& workpieces_;
  WarningPublisher& warnings_;
  sweep_guard_core::Time clock_seen_;
  QueueThread thread_;  // outlives what calls back on it
  ros::SteadyTimer timer_;
  ros::SteadyTimer reflex_timer_;
  ros::SteadyTimer considered_timer_;
};

}  // namespace sweep_guard_ros
