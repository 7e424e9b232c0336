#pragma once

#include <ros/node_handle.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace sweep_guard_ros {

/// The newest value of something that changes; waits until it fits. Any thread.
template <typename Value>
class Watched {
 public:
  void set(const Value& value) {
    const std::lock_guard lock(mutex_);
    newest_ = value;
    ++count_;
    changed_.notify_all();
  }

  /// Returns the first value from now on that fits. @throws std::runtime_error after 10 s
  Value await(const std::string& what, const std::function<bool(const Value&)>& fits) const {
    std::unique_lock lock(mutex_);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    for (size_t seen = count_;; seen = count_) {
      if (!changed_.wait_until(lock, deadline, [&] { return count_ > seen; })) {
        throw std::runtime_error("timeout: waited for " + what);
      }
      if (fits(*newest_)) return *newest_;
    }
  }

  Value next() const {
    return await("any value", [](const Value&) { return true; });
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<Value> newest_;
  size_t count_ = 0;
};

/// The newest message of a topic.
template <typename Msg>
class Listener : public Watched<Msg> {
 public:
  explicit Listener(const std::string& topic)
      : subscriber_(node_.subscribe<Msg>(
            topic, 100, [this](const typename Msg::ConstPtr& message) { this->set(*message); }, nullptr,
            ros::TransportHints().tcpNoDelay())) {}

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }

 private:
  ros::NodeHandle node_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_ros
