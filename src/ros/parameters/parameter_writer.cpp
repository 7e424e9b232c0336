#include "ros/parameters/parameter_writer.h"

#include <ros/master.h>

namespace sweep_guard_ros {
namespace {

constexpr auto kPause = std::chrono::milliseconds(500);  // before the next attempt

}  // namespace

ParameterWriter::ParameterWriter(const ros::NodeHandle& private_node)
    : node_(private_node), call_(kCallTimeout, stopping_) {}

ParameterWriter::~ParameterWriter() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ParameterWriter::start(Supervisor& supervisor) {
  top_ = &supervisor.add({"param_writer", sweep_guard_core::Stage::kOther, /*watched=*/false});
  thread_ = std::thread([this] { run(); });
}

bool ParameterWriter::write(const std::map<std::string, ParameterValue>& values, sweep_guard_core::Duration timeout) {
  std::unique_lock lock(mutex_);
  for (const auto& [key, value] : values) waiting_.insert_or_assign(key, value);
  changed_.notify_all();
  return changed_.wait_for(lock, timeout, [this] { return waiting_.empty(); });
}

void ParameterWriter::run() {
  top_->enter();
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
    if (!stopping_) writeNext(lock);
  }
}

void ParameterWriter::writeNext(std::unique_lock<std::mutex>& lock) {
  const auto [key, value] = *waiting_.begin();
  bool written = false;
  lock.unlock();
  top_->run([&, &key = key, &value = value] { written = writeOne(key, value); });
  lock.lock();
  const auto now = waiting_.find(key);
  if (written && now->second == value) waiting_.erase(now);
  changed_.notify_all();
  if (!written) changed_.wait_for(lock, kPause, [this] { return stopping_.load(); });
}

// Not by ros::param::set(): it locks all cached parameters until the master answers.
bool ParameterWriter::writeOne(const std::string& key, const ParameterValue& value) const {
  XmlRpc::XmlRpcValue payload;
  std::visit([&](const auto& held) { payload = held; }, value);
  const auto answer = call_.call(ros::master::getURI(), "setParam", {node_.resolveName(key), payload});
  return answer && answer->success;
}

}  // namespace sweep_guard_ros
