#include "ros/motion/output_watch.h"

#include <ros/console.h>
#include <ros/this_node.h>

#include <utility>

#include "ros/connection/publisher_links.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kPeriod = std::chrono::seconds(1);

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
  try {
    const auto publishers = registeredPublishers(call_, topic_);
    if (!publishers) return;
    std::vector<std::string> others;
    for (const std::string& node : *publishers) {
      if (node != ros::this_node::getName()) others.push_back(sweep_guard_core::printable(node));
    }
    const sweep_guard_core::Lock lock(mutex_);
    others_ = std::move(others);
  } catch (const XmlRpc::XmlRpcException& error) {
    ROS_ERROR_THROTTLE(60.0, "the ROS master's answer cannot be read: %s", error.getMessage().c_str());
  }
}

}  // namespace sweep_guard_ros
