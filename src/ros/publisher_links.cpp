#include "ros/publisher_links.h"

#include <poll.h>
#include <ros/xmlrpc_manager.h>

#include <cstdlib>
#include <mutex>
#include <utility>

namespace sweep_guard_ros {

using XmlRpc::XmlRpcValue;

namespace {

// roscpp tells the number of the socket in words. Where the publisher closed it while it was made, roscpp does not notice.
bool isDown(const XmlRpcValue& connection) {
  if (connection.size() < 7) return false;
  static const std::string kBefore = " on socket ";
  const std::string& transport = connection[6];
  const std::size_t place = transport.rfind(kBefore);
  if (place == std::string::npos) return false;
  pollfd socket{std::atoi(transport.c_str() + place + kBefore.size()), POLLRDHUP, 0};
  return socket.fd < 0 || (poll(&socket, 1, 0) == 1 && socket.revents != 0);
}

}  // namespace

std::string ownUri() { return ros::XMLRPCManager::instance()->getServerURI(); }

std::optional<PublisherLinks> publisherLinks(const XmlRpcCall& call) {
  const auto answer = call.call(ownUri(), "getBusInfo", {});
  if (!answer || !answer->success) return std::nullopt;
  PublisherLinks links;
  for (int i = 0; i < answer->value.size(); ++i) {
    const XmlRpcValue& connection = answer->value[i];
    const std::string& publisher = connection[1];
    const std::string& direction = connection[2];
    if (direction != "i") continue;
    links.all[connection[4]].insert(publisher);
    if (isDown(connection)) links.down[connection[4]].insert(publisher);
  }
  return links;
}

std::optional<PublishersOfTopics> connectedPublishers(const XmlRpcCall& call) {
  auto links = publisherLinks(call);
  if (!links) return std::nullopt;
  return std::move(links->all);
}

bool updatePublishers(const XmlRpcCall& call, const std::string& topic, const Publishers& added,
                      const Publishers& removed) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  auto connected = connectedPublishers(call);
  if (!connected) return false;
  Publishers& publishers = (*connected)[topic];
  publishers.insert(added.begin(), added.end());
  for (const std::string& publisher : removed) publishers.erase(publisher);
  XmlRpcValue all;
  all.setSize(0);
  for (const std::string& publisher : publishers) all[all.size()] = publisher;
  const auto answer = call.call(ownUri(), "publisherUpdate", {XmlRpcValue(topic), all});
  return answer && answer->success;
}

}  // namespace sweep_guard_ros
