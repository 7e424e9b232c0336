#include "ros/service/controls.h"

#include <ros/console.h>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
Controls::Controls(const ros::NodeHandle& private_node, const LiveParameters& parameters,
                   sweep_guard_core::WarningMonitor& monitor, const sweep_guard_core::WorkpieceStore& workpieces,
                   ServiceThreads& threads, GuardControls guard)
    : parameters_(parameters),
      monitor_(monitor),
      workpieces_(workpieces),
      guard_(std::move(guard)),
      calls_(threads.brief, threads.refusals),
      enable_server_(advertise(private_node, "enable", &Controls::onEnable)),
      reset_server_(advertise(private_node, "reset", &Controls::onReset)),
      acknowledge_server_(advertise(private_node, "acknowledge", &Controls::onAcknowledge)),
      reset_touches_server_(advertise(private_node, "reset_touches", &Controls::onResetTouches)) {}

template <typename Event>
ros::ServiceServer Controls::advertise(const ros::NodeHandle& node, const std::string& name,
                                       bool (Controls::*on_call)(Event&)) {
  return calls_.advertise<Event>(node, name, kMaxRequest,
                                 [this, on_call](Event& event) { return (this->*on_call)(event); });
}

bool Controls::onEnable(EnableEvent& event) {
  const std::string caller = sweep_guard_core::printable(event.getCallerName());
  if (event.getRequest().data) {
    enable(event.getResponse());
  } else {
    disable(caller, event.getResponse());
  }
  ROS_WARN("~enable called by %s: %s", caller.c_str(), event.getResponse().message.c_str());
  return true;
}

void Controls::enable(std_srvs::SetBool::Response& response) {
  response.success = true;
  const auto asked_by = monitor_.disabledBy();
  response.message = "already enabled";
  if (!asked_by) return;
  monitor_.enable();
  response.message = "enabled again after " + *asked_by + " had disabled it: coverage begins with the next tool pose";
}

void Controls::disable(const std::string& asked_by, std_srvs::SetBool::Response& response) {
  const std::string warning = monitor_.disableBelow(sweep_guard_core::WarningLevel::kReflex, now(), asked_by);
  if (!warning.empty()) {
    response.message = "not disabled during this warning: " + warning;
    return;
  }
  response.success = true;
  response.message = "disabled by " + monitor_.disabledBy().value_or(asked_by) + ": no motion is tested";
}

bool Controls::onAcknowledge(AcknowledgeEvent& event) {
  sweep_guard::Acknowledge::Response& response = event.getResponse();
  answerWith(response, [&] {
    const std::string& id = event.getRequest().mesh_id;
    if (!id.empty() && !sweep_guard_core::isName(id)) throw sweep_guard_core::InvalidInput("mesh_id is no name");
    response.mesh_id = guard_.acknowledge(id);
    response.until = toMsg(now().stamp + parameters_.get()->limits.acknowledge_time);
    return "the warning of '" + response.mesh_id + "' is acknowledged; it stays as it is";
  });
  ROS_INFO("~acknowledge called by %s: %s", sweep_guard_core::printable(event.getCallerName()).c_str(),
           response.message.c_str());
  return true;
}

bool Controls::onReset(ResetEvent& event) {
  std_srvs::Trigger::Response& response = event.getResponse();
  answerWith(response, [this] {
    guard_.reset();
    return "reset: tool poses, sweeps, the prediction and its training, held warnings, faults, and the counters of the "
           "diagnostics. Kept: workpieces (" +
           std::to_string(workpieces_.snapshot().size()) + "), parameters, level counts of the warning" +
           (monitor_.disabledBy() ? "; the guard stays disabled" : "");
  });
  ROS_WARN("~reset called: %s", response.message.c_str());
  return true;
}

bool Controls::onResetTouches(ResetEvent& event) {
  std_srvs::Trigger::Response& response = event.getResponse();
  answerWith(response, [this] {
    guard_.reset_touches();
    return "the counts of ~touches begin anew";
  });
  ROS_INFO("~reset_touches called by %s: %s", sweep_guard_core::printable(event.getCallerName()).c_str(),
           response.message.c_str());
  return true;
}

}  // namespace sweep_guard_ros
