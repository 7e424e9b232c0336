#pragma once

#include "ros/connection/master_watch.h"
#include "ros/guard/guard_runner.h"
#include "ros/guard/guard_state.h"
#include "ros/guard/watchdog.h"
#include "ros/input/inputs.h"
#include "ros/output/outputs.h"

namespace sweep_guard_ros {

/// Guards one tool, as a ROS node or a nodelet: each input has its own thread, one thread sweeps, and steady timers
/// warn even if the inputs are silent. doc/interface.md lists topics, services and parameters.
class SweepGuardNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  /// @throws sweep_guard_core::DeviceError if the detector cannot be created
  SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node, Process process);
  ~SweepGuardNode();
  SweepGuardNode(const SweepGuardNode&) = delete;
  SweepGuardNode& operator=(const SweepGuardNode&) = delete;

  void start();  ///< begins to guard; once

  const Parameters& parameters() const { return parameters_.initial(); }  ///< at the start

 private:
  void logStart() const;

  LiveParameters parameters_;
  MasterWatch master_watch_;  // before what registers at the master
  GuardState state_;
  GuardRunner guard_;
  Inputs inputs_;
  Outputs outputs_;
  Watchdog watchdog_;
};

}  // namespace sweep_guard_ros
