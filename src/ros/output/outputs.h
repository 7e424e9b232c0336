#pragma once

#include <memory>

#include "ros/guard/guard_runner.h"
#include "ros/guard/guard_state.h"
#include "ros/input/inputs.h"
#include "ros/output/diagnostics.h"
#include "ros/parameters/reconfigure_server.h"
#include "ros/service/attach.h"
#include "ros/service/check_sweep.h"
#include "ros/service/check_trajectory.h"
#include "ros/service/controls.h"
#include "ros/service/intend.h"
#include "ros/service/predict.h"
#include "ros/service/service_threads.h"
#include "ros/service/trajectory_watch.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Publishes periodically what the guard knows, beside the warning, and serves all services.
class Outputs {
 public:
  /// All must outlive this.
  /// @param master  writes parameters; must be stopped before this is destroyed
  Outputs(const ros::NodeHandle& node, const ros::NodeHandle& private_node, GuardState& state, GuardRunner& guard,
          Inputs& inputs, MasterThread& master);

  void start();
  void stopReports() { reports_.stop(); }
  void stopServices();  ///< after the guard, which running calls may wait for

 private:
  void apply(const std::shared_ptr<const Parameters>& wanted);

  GuardState& state_;
  GuardRunner& guard_;
  ServiceThreads service_threads_;  // before the services
  TimerThread reports_;
  TimerThread::Timer& marker_timer_;
  PathTests path_tests_;
  PathService check_sweep_;
  PathService check_trajectory_;
  TrajectoryWatch trajectory_watch_;
  PredictService predict_;
  Controls controls_;
  IntendService intend_;
  AttachService attach_;
  ReconfigureServer reconfigure_server_;
  Diagnostics diagnostics_;
};

}  // namespace sweep_guard_ros
