#pragma once

#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "ros/connection/bounded.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Tells whether one node alone publishes on a topic, by the messages: the master still lists a node that was killed.
class SolePublisher {
 public:
  /// @param silence  a node that has published nothing for longer counts no more
  explicit SolePublisher(sweep_guard_core::Duration silence) : silence_(silence) {}

  /// Takes note of a message, and returns whether it is from the only node.
  bool alone(const std::string& node, sweep_guard_core::SteadyTime received) {
    newest_[node] = received;
    for (auto one = newest_.begin(); one != newest_.end();) {
      one = received - one->second > silence_ ? newest_.erase(one) : std::next(one);
    }
    return newest_.size() == 1;
  }

 private:
  const sweep_guard_core::Duration silence_;
  std::map<std::string, sweep_guard_core::SteadyTime> newest_;  // message of each node
};

/// Subscribes to a topic that one node publishes.
/// @param silence  as of SolePublisher
/// @param hear     may throw sweep_guard_core::InvalidInput: the message is refused
/// @param refuse   takes why a message is refused: also while several nodes publish the topic
template <typename Msg>
BoundedSubscriber subscribeToSole(const ros::NodeHandle& node, const std::string& topic,
                                  sweep_guard_core::Duration silence, std::function<void(const Msg&)> hear,
                                  std::function<void(const std::string&)> refuse) {
  constexpr size_t kMaxMessageSize = 64 << 20;
  return subscribeBounded<Msg>(
      node, {topic, 10, kMaxMessageSize},
      [hear = std::move(hear), refuse,
       sole = SolePublisher(silence)](const ros::MessageEvent<const Msg>& event) mutable {
        try {
          if (!sole.alone(event.getPublisherName(), std::chrono::steady_clock::now())) {
            throw sweep_guard_core::InvalidInput("several nodes publish it");
          }
          hear(*event.getConstMessage());
        } catch (const sweep_guard_core::InvalidInput& error) {
          refuse(error.what());
        }
      },
      refuse);
}

}  // namespace sweep_guard_ros
