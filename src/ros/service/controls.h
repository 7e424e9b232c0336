#pragma once

#include <ros/service_server.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>

#include "ros/input/workpiece_store.h"
#include "sweep_guard/monitor/warning_monitor.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// The services `~enable` and `~reset`. Disabled is not clear: the warning is UNKNOWN, both flags stay raised. While
/// the level is REFLEX or CONTACT the guard refuses to be disabled: grey light would hide from the operator what he has
/// to see now. To reset is allowed always: a contact that is still there is found at the next pose. Where none comes,
/// it is forgotten, and the guard may be disabled: the warning is UNKNOWN, and says so.
class Controls {
 public:
  /// @param reset  forgets what came before, and returns when that is done
  Controls(const ros::NodeHandle& private_node, sweep_guard_core::WarningMonitor& monitor,
           const WorkpieceStore& workpieces, std::function<void()> reset);

  void start() { thread_.start(); }

 private:
  using EnableEvent = ros::ServiceEvent<std_srvs::SetBool::Request, std_srvs::SetBool::Response>;

  bool onEnable(EnableEvent& event);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void enable(std_srvs::SetBool::Response& response);
  void disable(const std::string& asked_by, std_srvs::SetBool::Response& response);

  sweep_guard_core::WarningMonitor& monitor_;
  const WorkpieceStore& workpieces_;
  const std::function<void()> reset_;
  QueueThread thread_;  // outlives what calls back on it
  ros::ServiceServer enable_server_;
  ros::ServiceServer reset_server_;
};

}  // namespace sweep_guard_ros
