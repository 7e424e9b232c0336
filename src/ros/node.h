#pragma once

#include <ros/steady_timer.h>

#include "ros/guard_thread.h"
#include "ros/output/diagnostics.h"
#include "ros/output/scene_publisher.h"
#include "ros/output/warning_publisher.h"
#include "ros/parameters/reconfigure_server.h"
#include "ros/service/check_sweep.h"
#include "ros/service/controls.h"
#include "ros/service/predict.h"
#include "ros/watchdog.h"

namespace sweep_guard_ros {

/// The guard of one tool as a ROS node, and as a nodelet: inputs on threads of their own, one thread that sweeps, and
/// steady timers that warn whatever the inputs do. Topics, services and parameters: doc/interface.md.
class SweepGuardNode {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused, sweep_guard_core::DeviceError if there is no detector
  SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~SweepGuardNode();
  SweepGuardNode(const SweepGuardNode&) = delete;
  SweepGuardNode& operator=(const SweepGuardNode&) = delete;

 private:
  void adopt(const std::shared_ptr<const Parameters>& next);
  void makeReports(const ros::NodeHandle& node);
  void greet() const;

  // What stands below calls back on what stands above; the monitor on the warnings, too.
  LiveParameters parameters_;
  sweep_guard_core::WarningMonitor monitor_;
  WarningPublisher warnings_;
  ScenePublisher scene_;
  QueueThread report_thread_;
  ros::SteadyTimer marker_timer_;
  ros::SteadyTimer view_timer_;
  SweepStatistics statistics_;
  Frames frames_;
  WorkpieceStore workpieces_;
  GuardThread guard_thread_;
  PoseInput poses_;
  MeshInput meshes_;
  CheckSweepService check_sweep_;
  PredictService predict_;
  Controls controls_;
  ReconfigureServer reconfigure_server_;
  Diagnostics diagnostics_;
  ros::SteadyTimer diagnostics_timer_;
  Watchdog watchdog_;
};

}  // namespace sweep_guard_ros
