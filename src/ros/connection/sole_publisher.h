#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Tells whether one node alone publishes on a topic, by the messages: the master still lists a node that was killed.
class SolePublisher {
 public:
  /// @param silence  a node that has published nothing for longer counts no more
  explicit SolePublisher(sweep_guard_core::Duration silence) : silence_(silence) {}

  /// Takes note of a message, and returns whether it is from the only node.
  bool alone(const std::string& node, sweep_guard_core::SteadyTime received) {
    const auto gone = [&](const Node& one) { return one.name == node || received - one.newest > silence_; };
    nodes_.erase(std::remove_if(nodes_.begin(), nodes_.end(), gone), nodes_.end());
    nodes_.push_back({node, received});
    return nodes_.size() == 1;
  }

 private:
  struct Node {
    std::string name;
    sweep_guard_core::SteadyTime newest;
  };
  const sweep_guard_core::Duration silence_;
  std::vector<Node> nodes_;
};

}  // namespace sweep_guard_ros
