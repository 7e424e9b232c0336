#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <sweep_guard/Interaction.h>

#include <boost/shared_ptr.hpp>
#include <chrono>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "rviz/panel_state.h"

namespace sweep_guard_rviz {

/// Receives warnings on a thread of its own, so that a busy rviz does not delay their time of arrival.
class WarningFeed {
 public:
  WarningFeed();
  ~WarningFeed();
  WarningFeed(const WarningFeed&) = delete;
  WarningFeed& operator=(const WarningFeed&) = delete;

  /// Switches to another topic and drops the warnings of the previous one. An empty topic ends listening.
  /// @throws ros::InvalidNameException if `topic` is not a valid name
  void listen(const std::string& topic);

  std::vector<ReceivedWarning> take();  ///< warnings received since the last call, in order

 private:
  void receive(const sweep_guard::Warning& warning);

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
  ros::Subscriber subscriber_;
  sweep_guard_core::Mutex mutex_;
  std::vector<ReceivedWarning> received_ GUARDED_BY(mutex_);
};

constexpr auto kSilent = std::chrono::milliseconds(500);  ///< after which a message is no longer shown

/// Returns force, volume and depth in words.
std::string describe(const sweep_guard::ObjectInteraction& object);

/// Returns the same for all workpieces: the whole force, the sum of the volumes and the largest depth; empty: there is no
/// force.
std::string describe(const sweep_guard::Interaction& interaction);

/// Keeps the newest message of a topic. The guard computes some only for subscribers: listen while they are shown.
template <typename Message>
class NewestFeed {
 public:
  NewestFeed() { node_.setCallbackQueue(&queue_); }

  /// Switches to another topic and forgets the message of the previous one. An empty topic ends listening.
  /// @throws ros::InvalidNameException if `topic` is not a valid name
  void listen(const std::string& topic) {
    if (topic == topic_) return;
    topic_ = topic;
    newest_.reset();
    subscriber_.shutdown();
    if (topic.empty()) return;
    const auto keep = [this](const boost::shared_ptr<const Message>& message) {
      newest_ = message;
      received_ = std::chrono::steady_clock::now();
    };
    subscriber_ = node_.subscribe<Message>(topic, 1, keep, nullptr, ros::TransportHints().tcpNoDelay());
  }
  const std::string& topic() const { return topic_; }

  /// Returns the newest message; null: there is none, or none came for 0.5 s.
  boost::shared_ptr<const Message> newest() {
    queue_.callAvailable();
    return std::chrono::steady_clock::now() - received_ > kSilent ? nullptr : newest_;
  }

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  std::string topic_;
  ros::Subscriber subscriber_;
  boost::shared_ptr<const Message> newest_;
  std::chrono::steady_clock::time_point received_;
};

}  // namespace sweep_guard_rviz
