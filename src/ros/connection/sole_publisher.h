#pragma once

#include <iterator>
#include <map>
#include <string>

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

}  // namespace sweep_guard_ros
