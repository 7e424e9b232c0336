#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <stdexcept>
#include <string>

namespace sweep_guard_ros {

/// Publishes to a topic that somebody has subscribed to: what is sent before is lost.
template <typename Message>
class ConnectedPublisher {
 public:
  /// Waits for a subscriber.
  /// @throws std::runtime_error after 20 s
  explicit ConnectedPublisher(const std::string& topic, bool latch = false) {
    const auto on_connect = [](const ros::SingleSubscriberPublisher& /*subscriber*/) {};
    auto options = ros::AdvertiseOptions::create<Message>(topic, 100, on_connect, ros::SubscriberStatusCallback(),
                                                          ros::VoidConstPtr(), &connections_);
    options.latch = latch;
    publisher_ = ros::NodeHandle().advertise(options);
    connections_.callOne(ros::WallDuration(20.0));
    if (publisher_.getNumSubscribers() == 0) throw std::runtime_error("nobody subscribes to " + topic);
  }

  ros::Publisher& operator*() { return publisher_; }

 private:
  ros::CallbackQueue connections_;
  ros::Publisher publisher_;
};

}  // namespace sweep_guard_ros
