#include "ros/motion/output_watch.h"

#include <ros/console.h>
#include <ros/master.h>
#include <ros/this_node.h>

#include <utility>

#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPeriod = std::chrono::seconds(1);

// Throws XmlRpcException if the master answers with something else.
std::vector<std::string> publishersIn(const XmlRpc::XmlRpcValue& system_state, const std::string& topic) {
  std::vector<std::string> publishers;
  const XmlRpc::XmlRpcValue& topics = system_state[0];
  for (int i = 0; i < topics.size(); ++i) {
    if (static_cast<const std::string&>(topics[i][0]) != topic) continue;
    const XmlRpc::XmlRpcValue& nodes = topics[i][1];
    for (int j = 0; j < nodes.size(); ++j) publishers.push_back(nodes[j]);
  }
  return publishers;
}

}  // namespace

OutputWatch::OutputWatch(std::string topic) : topic_(std::move(topic)), call_(kCallTimeout, stopping_) {
  thread_.every(kPeriod, [this] { check(); });
}

OutputWatch::~OutputWatch() {
  stopping_ = true;
  thread_.stop();
}

std::vector<std::string> OutputWatch::otherPublishers() const {
  const sweep_guard_core::Lock lock(mutex_);
  return others_;
}

void OutputWatch::check() {
  const auto state = call_.call(ros::master::getURI(), "getSystemState", {});
  if (!state || !state->success) return;
  try {
    std::vector<std::string> others;
    for (const std::string& node : publishersIn(state->value, topic_)) {
      if (node != ros::this_node::getName()) others.push_back(sweep_guard_core::printable(node));
    }
    const sweep_guard_core::Lock lock(mutex_);
    others_ = std::move(others);
  } catch (const XmlRpc::XmlRpcException& error) {
    ROS_ERROR_THROTTLE(60.0, "the ROS master's answer cannot be read: %s", error.getMessage().c_str());
  }
}

}  // namespace sweep_guard_ros
