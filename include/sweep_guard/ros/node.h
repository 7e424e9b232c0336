#pragma once

#include <ros/steady_timer.h>

#include "sweep_guard/ros/check_sweep.h"
#include "sweep_guard/ros/controls.h"
#include "sweep_guard/ros/diagnostics.h"
#include "sweep_guard/ros/predict.h"
#include "sweep_guard/ros/scene_output.h"
#include "sweep_guard/ros/sweeper.h"
#include "sweep_guard/ros/tuning.h"
#include "sweep_guard/ros/warning_output.h"
#include "sweep_guard/ros/watchdog.h"

namespace sweep_guard_ros {

/// The guard of one tool as a ROS node, and as a nodelet: inputs on threads of their own, one thread that sweeps, and
/// steady timers that warn whatever the inputs do. Topics, services and parameters: README.md.
class SweepGuardNode {
 public:
  /// @throws sweep_guard::InvalidInput if a parameter is refused, sweep_guard::DeviceError if there is no detector
  SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~SweepGuardNode();
  SweepGuardNode(const SweepGuardNode&) = delete;
  SweepGuardNode& operator=(const SweepGuardNode&) = delete;

 private:
  void adopt(const std::shared_ptr<const Parameters>& next);
  void makeReports(const ros::NodeHandle& node);
  void greet() const;

  // What stands below calls back on what stands above; the ledger on the warnings, too.
  LiveParameters parameters_;
  sweep_guard::Ledger ledger_;
  WarningOutput warnings_;
  SceneOutput scene_;
  QueueThread report_thread_;
  ros::SteadyTimer marker_timer_;
  ros::SteadyTimer view_timer_;
  Workload workload_;
  Frames frames_;
  WorkpieceStore workpieces_;
  Sweeper sweeper_;
  PoseInput poses_;
  MeshInput meshes_;
  CheckSweepService check_sweep_;
  PredictService predict_;
  Controls controls_;
  Tuning tuning_;
  Diagnostics diagnostics_;
  ros::SteadyTimer diagnostics_timer_;
  Watchdog watchdog_;
};

}  // namespace sweep_guard_ros
