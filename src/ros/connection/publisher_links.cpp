#include "ros/connection/publisher_links.h"

#include <netinet/in.h>
#include <poll.h>
#include <ros/master.h>
#include <ros/xmlrpc_manager.h>
#include <sys/socket.h>

#include <cstdlib>
#include <utility>

#include "sweep_guard/common/mutex.h"

namespace sweep_guard_ros {

using XmlRpc::XmlRpcValue;

namespace {

std::optional<int> numberAfter(const std::string& words, const std::string& text) {
  const std::size_t place = text.rfind(words);
  if (place == std::string::npos) return std::nullopt;
  return std::atoi(text.c_str() + place + words.size());
}

// Returns empty if it is no TCP socket.
std::optional<int> portOf(int socket) {
  sockaddr_in6 address{};  // that of IPv4 has its port at the same place
  socklen_t size = sizeof address;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  if (address.sin6_family != AF_INET && address.sin6_family != AF_INET6) return std::nullopt;
  return ntohs(address.sin6_port);
}

// roscpp tells port and socket in words, as in "TCPROS connection on port 59746 to [host:34318 on socket 11]", also after
// it has closed the socket, whose number may be another's by then. Where the publisher closed it while it was made, roscpp
// does not notice.
bool isDown(const XmlRpcValue& connection) {
  if (connection.size() < 7) return false;
  const std::string& transport = connection[6];
  const auto port = numberAfter(" on port ", transport);
  const auto number = numberAfter(" on socket ", transport);
  if (!port || !number) return false;
  if (portOf(*number) != port) return true;
  pollfd socket{*number, POLLRDHUP, 0};
  return poll(&socket, 1, 0) == 1 && socket.revents != 0;
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

std::optional<std::vector<std::string>> registeredPublishers(const XmlRpcCall& call, const std::string& topic) {
  const auto state = call.call(ros::master::getURI(), "getSystemState", {});
  if (!state || !state->success) return std::nullopt;
  std::vector<std::string> publishers;
  const XmlRpcValue& topics = state->value[0];
  for (int i = 0; i < topics.size(); ++i) {
    const std::string& name = topics[i][0];
    if (name != topic) continue;
    const XmlRpcValue& nodes = topics[i][1];
    for (int j = 0; j < nodes.size(); ++j) publishers.push_back(nodes[j]);
  }
  return publishers;
}

std::optional<Publishers> unconnectedPublishers(const XmlRpcCall& call, const std::string& topic) {
  const auto nodes = registeredPublishers(call, topic);
  auto connected = connectedPublishers(call);
  if (!nodes || !connected) return std::nullopt;
  Publishers unconnected;
  if (nodes->size() <= (*connected)[topic].size()) return unconnected;
  for (const std::string& node : *nodes) {
    const auto address = call.call(ros::master::getURI(), "lookupNode", {XmlRpcValue(node)});
    if (!address || !address->success) continue;
    const std::string& publisher = address->value;
    if ((*connected)[topic].count(publisher) == 0) unconnected.insert(publisher);
  }
  return unconnected;
}

bool updatePublishers(const XmlRpcCall& call, const std::string& topic, const Publishers& added,
                      const Publishers& removed) {
  static sweep_guard_core::Mutex one_at_a_time;
  const sweep_guard_core::Lock lock(one_at_a_time);
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
