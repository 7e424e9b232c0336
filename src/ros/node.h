#pragma once

#include "ros/connection/master_watch.h"
#include "ros/connection/peer_watch.h"
#include "ros/guard/cross_check_thread.h"
#include "ros/guard/guard_thread.h"
#include "ros/guard/watchdog.h"
#include "ros/input/mesh_input.h"
#include "ros/input/other_tools.h"
#include "ros/input/pose_input.h"
#include "ros/output/diagnostics.h"
#include "ros/output/scene_publisher.h"
#include "ros/output/touches_publisher.h"
#include "ros/output/warning_publisher.h"
#include "ros/parameters/reconfigure_server.h"
#include "ros/service/attach.h"
#include "ros/service/check_sweep.h"
#include "ros/service/check_trajectory.h"
#include "ros/service/controls.h"
#include "ros/service/intend.h"
#include "ros/service/predict.h"
#include "ros/service/service_threads.h"
#include "ros/threads/supervisor.h"
#include "ros/threads/timer_thread.h"

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
  void apply(const std::shared_ptr<const Parameters>& wanted);
  void logStart() const;

  // Members use only earlier members. Exception: the monitor reports faults to warnings_ and asks
  // supervisor_, which reports failures to warnings_ and statistics_.
  LiveParameters parameters_;
  MasterWatch master_watch_;  // before what registers at the master
  sweep_guard_core::WorkQueue queue_;
  sweep_guard_core::WarningMonitor monitor_;
  Supervisor supervisor_;  // before all threads
  ServiceThreads service_threads_;
  WarningPublisher warnings_;
  ScenePublisher scene_;
  TouchesPublisher touches_;
  TimerThread reports_;
  TimerThread::Timer& marker_timer_;
  sweep_guard_core::SweepStatistics statistics_;
  Frames frames_;
  sweep_guard_core::IntentionStore intentions_;
  sweep_guard_core::AllowedMatches allowed_;
  sweep_guard_core::WorkpieceStore workpieces_;
  sweep_guard_core::FrameMotionStore frame_motions_;
  CrossCheckThread cross_check_;
  GuardThread guard_thread_;
  PoseInput poses_;
  MeshInput meshes_;
  OtherTools other_tools_;
  PathTests path_tests_;
  CheckSweepService check_sweep_;
  CheckTrajectoryService check_trajectory_;
  PredictService predict_;
  Controls controls_;
  IntendService intend_;
  AttachService attach_;
  ReconfigureServer reconfigure_server_;
  Diagnostics diagnostics_;
  Watchdog watchdog_;
  PeerWatch peer_watch_;
};

}  // namespace sweep_guard_ros
