#pragma once

#include <sweep_guard/Proximity.h>
#include <sweep_guard/ToolBalls.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "guard_probe.h"

namespace sweep_guard_ros {

/// Keeps all messages of one topic of the guard.
template <typename Message>
class TopicListener {
 public:
  explicit TopicListener(const std::string& topic)
      : subscriber_(node_.subscribe<Message>("/sweep_guard/" + topic, 1000, [this](const auto& message) {
          const std::lock_guard lock(mutex_);
          messages_.push_back(*message);
          changed_.notify_all();
        })) {}

  /// Returns the newest message, once it fits. @throws std::runtime_error after 20 s
  Message awaitNewest(const std::function<bool(const Message&)>& fits) const {
    std::unique_lock lock(mutex_);
    const auto there = [&] { return !messages_.empty() && fits(messages_.back()); };
    if (!changed_.wait_for(lock, std::chrono::seconds(20), there)) throw std::runtime_error("no such message");
    return messages_.back();
  }
  std::vector<Message> all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<Message> messages_;
  ros::NodeHandle node_;
  ros::Subscriber subscriber_;  // ends before what its callback uses
};

}  // namespace sweep_guard_ros
