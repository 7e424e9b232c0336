#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sweep_guard/Warning.h>

#include <mutex>

#include "ros/parameters/parameters.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Publishes `~warning`, and the flags `~reflex_warning` and `~considered_warning` at once when they rise. Any thread.
class WarningPublisher {
 public:
  WarningPublisher(ros::NodeHandle private_node, const LiveParameters& parameters,
                   const sweep_guard_core::WarningMonitor& monitor);

  void warnOfChange();      ///< of level or reasons, if there is one
  void warnInTime();        ///< likewise, and of what stays as it is often enough for 20 Hz
  void repeatReflex();      ///< as it is now, not as it was when the warning was sent last
  void repeatConsidered();  ///< likewise

 private:
  using Flag = sweep_guard::Warning::_reflex_type sweep_guard::Warning::*;

  void warn(bool only_on_change);
  void repeat(const ros::Publisher& publisher, Flag flag);

  const LiveParameters& parameters_;
  const sweep_guard_core::WarningMonitor& monitor_;
  ros::Publisher warning_publisher_;
  ros::Publisher reflex_publisher_;
  ros::Publisher considered_publisher_;

  std::mutex mutex_;
  sweep_guard_core::Warning warning_;  // newest
  sweep_guard::Warning message_;       // counters and level last sent
  sweep_guard_core::SteadyTime warned_;
};

}  // namespace sweep_guard_ros
