#include "ros/output/start_failure.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/console.h>
#include <ros/master.h>

#include "ros/connection/xml_rpc_call.h"
#include "ros/output/flush.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kTime = std::chrono::seconds(1);
constexpr const char* kTopic = "/diagnostics";

// Throws XmlRpcException if the master answers with something else.
std::uint32_t subscribersIn(const XmlRpc::XmlRpcValue& system_state) {
  const XmlRpc::XmlRpcValue& topics = system_state[1];
  for (int i = 0; i < topics.size(); ++i) {
    if (static_cast<const std::string&>(topics[i][0]) == kTopic) return static_cast<std::uint32_t>(topics[i][1].size());
  }
  return 0;
}

std::uint32_t subscribers() {
  static const std::atomic<bool> never = false;
  const auto state = XmlRpcCall(kTime, never).call(ros::master::getURI(), "getSystemState", {});
  if (!state || !state->success) return 0;
  try {
    return subscribersIn(state->value);
  } catch (const XmlRpc::XmlRpcException&) {
    return 0;
  }
}

}  // namespace

void reportStartFailure(ros::NodeHandle node, const std::string& name, const std::string& message) {
  ROS_FATAL("%s", message.c_str());
  const std::uint32_t listening = subscribers();
  if (listening == 0) return;
  ros::Publisher publisher = node.advertise<diagnostic_msgs::DiagnosticArray>(kTopic, 1, /*latch=*/true);
  diagnostic_msgs::DiagnosticArray diagnostics;
  diagnostics.header.stamp = ros::Time::now();
  diagnostics.status.resize(1);
  diagnostics.status[0].level = diagnostic_msgs::DiagnosticStatus::ERROR;
  diagnostics.status[0].name = name + ": start";
  diagnostics.status[0].message = message;
  publisher.publish(diagnostics);
  const auto deadline = std::chrono::steady_clock::now() + kTime;
  while (publisher.getNumSubscribers() < listening && std::chrono::steady_clock::now() < deadline) {
    ros::WallDuration(0.01).sleep();
  }
  flush();
}

}  // namespace sweep_guard_ros
