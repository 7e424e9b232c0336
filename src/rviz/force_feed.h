#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <sweep_guard/Interaction.h>

#include <chrono>
#include <string>

namespace sweep_guard_rviz {

constexpr auto kSilent = std::chrono::milliseconds(500);  ///< after which a message is no longer shown

/// Returns force, volume and depth in words.
std::string describe(const sweep_guard::ObjectInteraction& object);

/// Returns the same for all workpieces: the whole force, the sum of the volumes and the largest depth; empty: there is no
/// force.
std::string describe(const sweep_guard::Interaction& interaction);

/// Receives the force on the tool. The guard computes it only for subscribers: listen while it is shown.
class ForceFeed {
 public:
  ForceFeed() { node_.setCallbackQueue(&queue_); }

  /// Switches to another topic and forgets the force of the previous one. An empty topic ends listening.
  void listen(const std::string& topic);

  /// Returns the newest force in words; empty: there is none, or none came for 0.5 s.
  std::string text();

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::string topic_;
  ros::Subscriber subscriber_;
  std::string text_;
  std::chrono::steady_clock::time_point received_;
};

}  // namespace sweep_guard_rviz
