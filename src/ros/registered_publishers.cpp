#include "ros/registered_publishers.h"

#include <ros/master.h>

namespace sweep_guard_ros {
namespace {

// Throws XmlRpcException if the master answers with something else.
std::set<std::string> publishersIn(const XmlRpc::XmlRpcValue& system_state, const std::string& topic) {
  std::set<std::string> nodes;
  const XmlRpc::XmlRpcValue& topics = system_state[0];
  for (int i = 0; i < topics.size(); ++i) {
    if (static_cast<const std::string&>(topics[i][0]) != topic) continue;
    const XmlRpc::XmlRpcValue& names = topics[i][1];
    for (int j = 0; j < names.size(); ++j) nodes.insert(static_cast<const std::string&>(names[j]));
  }
  return nodes;
}

}  // namespace

std::optional<std::set<std::string>> registeredPublishers(const XmlRpcCall& call, const std::string& topic) {
  const auto state = call.call(ros::master::getURI(), "getSystemState", {});
  if (!state || !state->success) return {};
  try {
    return publishersIn(state->value, topic);
  } catch (const XmlRpc::XmlRpcException&) {
    return {};
  }
}

}  // namespace sweep_guard_ros
