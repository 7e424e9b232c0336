#include "ros/connection/message_drops.h"

#include "ros/connection/publisher_links.h"

namespace sweep_guard_ros {

// roscpp writes the statistics where its answer should have status and text: those of publishers, of subscribers.
std::optional<int> messageDrops(const XmlRpcCall& call, const std::string& topic) {
  const auto statistics = call.callUnchecked(ownUri(), "getBusStats", {});
  if (!statistics) return std::nullopt;
  int drops = 0;
  const XmlRpc::XmlRpcValue& subscriptions = (*statistics)[1];
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
