#include "ros/parameters/parameter_writer.h"

#include <ros/master.h>

namespace sweep_guard_ros {
namespace {

constexpr auto kRetryPeriod = std::chrono::milliseconds(500);
constexpr auto kMaxWrite = std::chrono::milliseconds(500);

}  // namespace

ParameterWriter::ParameterWriter(const ros::NodeHandle& private_node, MasterThread& thread)
    : node_(private_node), call_(thread.call()) {
  thread.every(kRetryPeriod, [this] {
    const sweep_guard_core::Lock lock(mutex_);
    writeWaiting();
  });
}

bool ParameterWriter::write(const std::map<std::string, ParameterValue>& values) {
  const sweep_guard_core::Lock lock(mutex_);
  for (const auto& [key, value] : values) waiting_.insert_or_assign(key, value);
  return writeWaiting();
}

bool ParameterWriter::writeWaiting() {
  const auto end = std::chrono::steady_clock::now() + kMaxWrite;
  while (!waiting_.empty() && std::chrono::steady_clock::now() < end) {
    const auto next = waiting_.begin();
    if (!writeOne(next->first, next->second)) return false;
    waiting_.erase(next);
  }
  return waiting_.empty();
}

// Not by ros::param::set(): it locks all cached parameters until the master answers.
bool ParameterWriter::writeOne(const std::string& key, const ParameterValue& value) const {
  XmlRpc::XmlRpcValue payload;
  std::visit([&](const auto& held) { payload = held; }, value);
  const auto answer = call_.call(ros::master::getURI(), "setParam", {node_.resolveName(key), payload});
  return answer && answer->success;
}

}  // namespace sweep_guard_ros
