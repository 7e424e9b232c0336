#include "ros/connection/message_drops.h"

#include "ros/connection/publisher_links.h"

namespace sweep_guard_ros {

std::optional<int> messageDrops(const XmlRpcCall& call, const std::string& topic) {
  const auto answer = call.call(ownUri(), "getBusStats", {});
  if (!answer || !answer->success) return std::nullopt;
  int drops = 0;
  const XmlRpc::XmlRpcValue& subscriptions = answer->value[1];
  for (int i = 0; i < subscriptions.size(); ++i) {
    const std::string& name = subscriptions[i][0];
    if (name != topic) continue;
    const XmlRpc::XmlRpcValue& connections = subscriptions[i][1];
    for (int j = 0; j < connections.size(); ++j) {
      const int& of_connection = connections[j][3];
      drops += of_connection;
    }
  }
  return drops;
}

}  // namespace sweep_guard_ros
