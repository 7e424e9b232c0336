#include "ros/publisher_links.h"

#include <ros/master.h>
#include <ros/xmlrpc_manager.h>

#include <mutex>

namespace sweep_guard_ros {

using XmlRpc::XmlRpcValue;

std::string ownUri() { return ros::XMLRPCManager::instance()->getServerURI(); }

std::optional<std::map<std::string, Publishers>> connectedPublishers(const XmlRpcCall& call) {
  const auto answer = call.call(ownUri(), "getBusInfo", {});
  if (!answer || !answer->success) return std::nullopt;
  std::map<std::string, Publishers> publishers;
  for (int i = 0; i < answer->value.size(); ++i) {
    const XmlRpcValue& connection = answer->value[i];
    const std::string& publisher = connection[1];
    const std::string& direction = connection[2];
    if (direction == "i") publishers[connection[4]].insert(publisher);
  }
  return publishers;
}

std::optional<Publishers> registerSubscriber(const XmlRpcCall& call, const std::string& topic,
                                             const std::string& type) {
  const auto known = call.call(ros::master::getURI(), "registerSubscriber",
                               {XmlRpcValue(topic), XmlRpcValue(type), XmlRpcValue(ownUri())});
  if (!known || !known->success) return std::nullopt;
  Publishers publishers;
  for (int i = 0; i < known->value.size(); ++i) publishers.insert(static_cast<const std::string&>(known->value[i]));
  return publishers;
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
