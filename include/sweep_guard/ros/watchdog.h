#pragma once

#include <ros/steady_timer.h>

#include "sweep_guard/guard/ledger.h"
#include "sweep_guard/ros/queue_thread.h"
#include "sweep_guard/ros/warning_output.h"
#include "sweep_guard/ros/workpiece_store.h"

namespace sweep_guard_ros {

/// Steady timers that warn and repeat the flags whatever the inputs do, and watch the clock of the stamps: when it goes
/// back (a bag that loops, a simulation that starts again), every stamp of before is meaningless. Its own thread.
class Watchdog {
 public:
  Watchdog(const ros::NodeHandle& node, sweep_guard::Ledger& ledger, WorkpieceStore& workpieces,
           WarningOutput& warnings);

  void start() { thread_.start(); }

 private:
  void watchClock();

  sweep_guard::Ledger& ledger_;
  WorkpieceStore& workpieces_;
  WarningOutput& warnings_;
  sweep_guard::Time clock_seen_;
  QueueThread thread_;  // outlives what calls back on it
  ros::SteadyTimer timer_;
  ros::SteadyTimer reflex_timer_;
  ros::SteadyTimer considered_timer_;
};

}  // namespace sweep_guard_ros
