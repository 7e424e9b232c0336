#include "ros/connection/master_watch.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/service_manager.h>
#include <ros/this_node.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>

#include "ros/connection/host_address.h"
#include "ros/connection/own_services.h"

namespace sweep_guard_ros {
namespace {

using XmlRpc::XmlRpcValue;

constexpr auto kMasterPeriod = std::chrono::seconds(1);
constexpr auto kBriefCall = std::chrono::milliseconds(200);
constexpr int kChecksPerLook = 3;  // for publishers that are missing
// Those that roscpp and nodelet advertise.
constexpr std::array kServicesOfTheProcess = {"get_loggers", "list", "load_nodelet", "set_logger_level",
                                              "unload_nodelet"};

}  // namespace

MasterWatch::MasterWatch(const ros::NodeHandle& private_node, std::function<ParameterReader::Settings()> settings)
    : namespace_(private_node.getNamespace()),
      settings_(std::move(settings)),
      service_address_("rosrpc://" + ros::network::getHost() + ":" +
                       std::to_string(ros::ConnectionManager::instance()->getTCPPort())),
      call_(thread_.call()),
      brief_call_(kBriefCall, thread_.stopping()),
      master_(identity()) {
  thread_.every(kMasterPeriod, [this] { checkOrLog(); });
}

void MasterWatch::checkOrLog() {
  try {
    check();
  } catch (const XmlRpc::XmlRpcException& error) {
    ROS_ERROR_THROTTLE(60.0, "the ROS master's answer cannot be read: %s", error.getMessage().c_str());
  }
}

// Those that run without roscore have no run id, and in a container each may have the same process id.
std::optional<std::string> MasterWatch::identity() const {
  const std::string& uri = ros::master::getURI();
  const auto process = (answers_ ? call_ : brief_call_).call(uri, "getPid", {});
  if (!process) return std::nullopt;
  const auto run_id = call_.call(uri, "getParam", {XmlRpcValue("/run_id")});
  if (!run_id) return std::nullopt;
  return process->value.toXml() + run_id->value.toXml();
}

void MasterWatch::check() {
  const auto master = identity();
  std::optional<XmlRpcCall::Answer> node;
  if (master) node = call_.call(ros::master::getURI(), "lookupNode", {XmlRpcValue(ros::this_node::getName())});
  const bool answers = node.has_value();
  if (thread_.stopping() || ros::isShuttingDown()) return;
  if (answers_ && !answers) ROS_WARN("the ROS master does not answer: this node goes on with the connections it has");
  if (!answers_ && answers) ROS_WARN("the ROS master answers again");
  answers_ = answers;
  if (!answers) return;
  if (node->success && master == master_) {
    if (++checks_ % kChecksPerLook == 0) connectMissing();
    return;
  }
  if (!registerAnew()) return;
  master_ = master;
  ROS_WARN("the ROS master was started anew: topics, services and parameters are registered there again");
}

// Parameters first: a guard that is started again soon finds them.
bool MasterWatch::registerAnew() { return setParameters() && registerServices() && registerTopics(); }

// Those that are there were set after the start of the master, by us or by roslaunch.
bool MasterWatch::setParameters() {
  for (const auto& [key, value] : settings_()) {
    const std::string name = key.front() == '/' ? key : ros::names::append(namespace_, key);
    const auto there = call_.call(ros::master::getURI(), "hasParam", {XmlRpcValue(name)});
    if (!there || !there->success) return false;
    if (value && !static_cast<bool>(there->value) && !request("setParam", {XmlRpcValue(name), *value})) return false;
  }
  return true;
}

bool MasterWatch::registerServices() {
  std::set<std::string> services = ownServices();
  for (const char* const name : kServicesOfTheProcess)
    services.insert(ros::names::append(ros::this_node::getName(), name));
  for (const std::string& service : services) {
    if (!ros::ServiceManager::instance()->lookupServicePublication(service)) continue;
    if (!request("registerService", {XmlRpcValue(service), XmlRpcValue(service_address_), XmlRpcValue(ownUri())}))
      return false;
  }
  return true;
}

bool MasterWatch::registerTopics() {
  const auto published = call_.call(ownUri(), "getPublications", {});
  const auto subscribed = call_.call(ownUri(), "getSubscriptions", {});
  if (!published || !subscribed) return false;
  for (int i = 0; i < published->value.size(); ++i) {
    const XmlRpcValue& topic = published->value[i];
    if (!request("registerPublisher", {topic[0], topic[1], XmlRpcValue(ownUri())})) return false;
  }
  for (int i = 0; i < subscribed->value.size(); ++i) {
    if (!subscribe(subscribed->value[i])) return false;
  }
  return true;
}

// Asks until nothing is new: a publisher that registers meanwhile may have been disconnected again.
bool MasterWatch::subscribe(const XmlRpcValue& topic) {
  std::optional<Publishers> connected;
  while (true) {
    auto publishers = registerSubscriber(topic);
    if (!publishers) return false;
    if (publishers == connected) return true;
    if (!updatePublishers(call_, topic[0], *publishers)) return false;
    connected = std::move(publishers);
  }
}

std::optional<Publishers> MasterWatch::registerSubscriber(const XmlRpcValue& topic) {
  const auto known =
      call_.call(ros::master::getURI(), "registerSubscriber", {topic[0], topic[1], XmlRpcValue(ownUri())});
  if (!known || !known->success) return std::nullopt;
  Publishers publishers;
  for (int i = 0; i < known->value.size(); ++i) publishers.insert(static_cast<const std::string&>(known->value[i]));
  return publishers;
}

// Those that were missing at the last look, too: a publisher that has just begun is being connected.
void MasterWatch::connectMissing() {
  auto missing = missingPublishers();
  if (!missing) return;
  for (auto& [topic, publishers] : *missing) {
    const Publishers& before = missing_[topic];
    Publishers again;
    std::set_intersection(publishers.begin(), publishers.end(), before.begin(), before.end(),
                          std::inserter(again, again.end()));
    if (again.empty()) continue;
    ROS_WARN_THROTTLE(60.0, "%s of %s is known to the ROS master and not connected: it is connected anew",
                      again.begin()->c_str(), topic.c_str());
    updatePublishers(call_, topic, again);
  }
  missing_ = std::move(*missing);
}

std::optional<PublishersOfTopics> MasterWatch::missingPublishers() const {
  const auto subscribed = call_.call(ownUri(), "getSubscriptions", {});
  if (!subscribed) return std::nullopt;
  PublishersOfTopics missing;
  for (int i = 0; i < subscribed->value.size(); ++i) missing[subscribed->value[i][0]];
  if (!addPublishersAtMaster(missing)) return std::nullopt;
  const auto connected = connectedPublishers(call_);
  if (!connected) return std::nullopt;
  for (auto& [topic, publishers] : missing) {
    publishers.erase(ownUri());
    const auto there = connected->find(topic);
    if (there == connected->end()) continue;
    for (const std::string& publisher : there->second) publishers.erase(publisher);
  }
  return missing;
}

// Asks for each node once, and no more once the master is silent.
bool MasterWatch::addPublishersAtMaster(PublishersOfTopics& topics) const {
  const auto state = call_.call(ros::master::getURI(), "getSystemState", {});
  if (!state || !state->success) return false;
  std::map<std::string, std::optional<std::string>> addresses;  // of nodes
  for (int i = 0; i < state->value[0].size(); ++i) {
    const XmlRpcValue& published = state->value[0][i];
    const auto topic = topics.find(published[0]);
    if (topic == topics.end()) continue;
    for (int j = 0; j < published[1].size(); ++j) {
      const auto [node, is_new] = addresses.try_emplace(published[1][j]);
      if (is_new && !lookUp(node->first, node->second)) return false;
      if (node->second) topic->second.insert(*node->second);
    }
  }
  return true;
}

// roscpp looks up the names of hosts while all calls to this node wait: one that cannot be looked up is left out.
bool MasterWatch::lookUp(const std::string& node, std::optional<std::string>& address) const {
  const auto known = call_.call(ros::master::getURI(), "lookupNode", {XmlRpcValue(node)});
  if (!known) return false;
  std::string host;
  std::uint32_t port = 0;
  if (!known->success) return true;
  const std::string& uri = known->value;
  if (ros::network::splitURI(uri, host, port) && hostAddress(host)) address = uri;
  return true;
}

bool MasterWatch::request(const std::string& function, const std::vector<XmlRpcValue>& arguments) {
  const auto answer = call_.call(ros::master::getURI(), function, arguments);
  return answer && answer->success;
}

}  // namespace sweep_guard_ros
