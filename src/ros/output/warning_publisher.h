#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sweep_guard/Warning.h>

#include "common/guarded_by.h"
#include "ros/parameters/live_parameters.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Publishes `~warning`, and publishes the flags `~reflex_warning` and `~considered_warning` at once when they rise.
/// Any thread.
class WarningPublisher {
 public:
  WarningPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                   const sweep_guard_core::WarningMonitor& monitor);

  void publishIfChanged();   ///< publishes if level, reasons, `held`, `acknowledged` or `intended` have changed
  void publishIfDue();       ///< publishes on change, and otherwise often enough for 20 Hz
  void publishFinal();       ///< publishes the warning and both flags, and waits until they are sent, up to 0.2 s
  void publishReflex();      ///< publishes the flag as it is now, and the warning if it has changed
  void publishConsidered();  ///< the same for the other flag

 private:
  using Flag = sweep_guard::Warning::_reflex_type sweep_guard::Warning::*;

  void publish(bool only_if_changed) REQUIRES(mutex_);
  void publishFlag(const ros::Publisher& publisher, Flag flag);

  const LiveParameters& parameters_;
  const sweep_guard_core::WarningMonitor& monitor_;
  ros::Publisher warning_publisher_;
  ros::Publisher reflex_publisher_;
  ros::Publisher considered_publisher_;

  sweep_guard_core::Mutex mutex_;
  sweep_guard_core::Warning warning_ GUARDED_BY(mutex_);       // newest
  sweep_guard::Warning message_ GUARDED_BY(mutex_);            // published last
  sweep_guard_core::SteadyTime published_ GUARDED_BY(mutex_);  // time of that message
};

}  // namespace sweep_guard_ros
