#include "roscpp_alone.h"

#include <ros/advertise_service_options.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/subscribe_options.h>

#include <cstdlib>

namespace sweep_guard_fuzz {
namespace {

void start() {
  setenv("ROS_MASTER_URI", "http://127.0.0.1:1", /*overwrite=*/1);  // nobody answers there
  setenv("ROS_IP", "127.0.0.1", 1);
  ros::M_string no_remappings;
  ros::init(no_remappings, "fuzz", ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Fatal);
  ros::console::set_logger_level("ros", ros::console::levels::Fatal);
  ros::console::set_logger_level("ros.roscpp", ros::console::levels::Fatal);
  ros::console::notifyLoggerLevelsChanged();
  ros::master::setRetryTimeout(ros::WallDuration(0.001));
  static const ros::NodeHandle alive;
  ros::Time::setNow(ros::Time(1000.0));
}

void addNames(const std::string& name, const XmlRpc::XmlRpcValue& value, std::vector<std::string>& names) {
  if (value.getType() != XmlRpc::XmlRpcValue::TypeStruct) return names.push_back(name);
  XmlRpc::XmlRpcValue group = value;
  for (const auto& [key, member] : group) addNames(std::string(name).append("/").append(key), member, names);
}

}  // namespace

void startRoscpp() {
  static const bool started = (start(), true);
  static_cast<void>(started);
}

std::map<std::string, XmlRpc::XmlRpcValue>& serverParameters() {
  static std::map<std::string, XmlRpc::XmlRpcValue> parameters;
  return parameters;
}

std::map<std::string, Service>& services() {
  static std::map<std::string, Service> noted;
  return noted;
}

std::map<std::string, ros::SubscriptionCallbackHelperPtr>& subscriptions() {
  static std::map<std::string, ros::SubscriptionCallbackHelperPtr> noted;
  return noted;
}

}  // namespace sweep_guard_fuzz

// In place of those of the library.
namespace ros {

bool NodeHandle::getParam(const std::string& key, XmlRpc::XmlRpcValue& value) const {
  const auto found = sweep_guard_fuzz::serverParameters().find(resolveName(key));
  if (found == sweep_guard_fuzz::serverParameters().end()) return false;
  value = found->second;
  return true;
}

bool NodeHandle::getParamNames(std::vector<std::string>& names) const {
  for (const auto& [name, value] : sweep_guard_fuzz::serverParameters()) sweep_guard_fuzz::addNames(name, value, names);
  return true;
}

bool NodeHandle::searchParam(const std::string& key, std::string& name) const {
  for (const std::string& candidate : {names::append(getNamespace(), key), names::append("/", key)}) {
    name = candidate;
    if (sweep_guard_fuzz::serverParameters().count(name) != 0) return true;
  }
  return false;
}

Subscriber NodeHandle::subscribe(SubscribeOptions& options) {
  sweep_guard_fuzz::subscriptions()[resolveName(options.topic)] = options.helper;
  return {};
}

ServiceServer NodeHandle::advertiseService(AdvertiseServiceOptions& options) {
  CallbackQueueInterface* const queue = options.callback_queue != nullptr ? options.callback_queue : callback_queue_;
  sweep_guard_fuzz::services()[resolveName(options.service)] = {options.helper, queue};
  return {};
}

}  // namespace ros
