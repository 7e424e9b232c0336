#pragma once

#include <ros/service_server.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sweep_guard/Acknowledge.h>

#include <functional>

#include "guard/workpiece_store.h"
#include "ros/parameters/live_parameters.h"
#include "ros/service/limited_calls.h"
#include "ros/service/service_threads.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// What Controls asks of the guard. Each returns when it is done; those of its thread throw sweep_guard_core::Error.
struct GuardControls {
  std::function<void()> reset;                                    ///< see GuardThread::reset()
  std::function<std::string(const std::string& id)> acknowledge;  ///< see GuardThread::acknowledge()
  std::function<void()> reset_touches;                            ///< see TouchesPublisher::reset()
};

/// Serves `~enable`, `~reset`, `~acknowledge` and `~reset_touches`. While disabled, the warning is UNKNOWN and both flags
/// stay raised. The guard refuses to be disabled at REFLEX or CONTACT: a gray light would hide the danger from the
/// operator. It may be reset at any level: a contact that lasts is found again at the next pose. Without a next pose the contact
/// is forgotten, and the warning is UNKNOWN. Five calls of these services are let in; any more are answered BUSY.
class Controls {
 public:
  Controls(const ros::NodeHandle& private_node, const LiveParameters& parameters,
           sweep_guard_core::WarningMonitor& monitor, const sweep_guard_core::WorkpieceStore& workpieces,
           ServiceThreads& threads, GuardControls guard);

 private:
  using AcknowledgeEvent = ros::ServiceEvent<sweep_guard::Acknowledge::Request, sweep_guard::Acknowledge::Response>;
  using ResetEvent = ros::ServiceEvent<std_srvs::Trigger::Request, std_srvs::Trigger::Response>;
  using EnableEvent = ros::ServiceEvent<std_srvs::SetBool::Request, std_srvs::SetBool::Response>;

  bool onEnable(EnableEvent& event);
  bool onAcknowledge(AcknowledgeEvent& event);
  bool onReset(ResetEvent& event);
  bool onResetTouches(ResetEvent& event);
  template <typename Event>
  ros::ServiceServer advertise(const ros::NodeHandle& node, const std::string& name, bool (Controls::*on_call)(Event&));
  void enable(std_srvs::SetBool::Response& response);
  void disable(const std::string& asked_by, std_srvs::SetBool::Response& response);

  const LiveParameters& parameters_;
  sweep_guard_core::WarningMonitor& monitor_;
  const sweep_guard_core::WorkpieceStore& workpieces_;
  const GuardControls guard_;
  LimitedCalls calls_;  // before the servers, which use it
  ros::ServiceServer enable_server_;
  ros::ServiceServer reset_server_;
  ros::ServiceServer acknowledge_server_;
  ros::ServiceServer reset_touches_server_;
};

}  // namespace sweep_guard_ros
