#pragma once

#include <ros/node_handle.h>
#include <ros/single_subscriber_publisher.h>

#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "session/session_start.h"

namespace sweep_guard_session {

/// Gives what was recorded before the start of a session to each subscriber that connects, as one latched publisher for each message
/// would. One thread.
class StartPublisher {
 public:
  /// Reads the messages. `files` must outlive this.
  /// @param guard  node that hasGiven() asks about
  StartPublisher(const SessionFiles& files, SessionTopics topics, sweep_guard_core::Time start, std::string guard)
      : files_(files), topics_(std::move(topics)), guard_(std::move(guard)), start_(readStart(files, topics_, start)) {}

  const SessionStart& start() const { return start_; }

  template <typename Pointer>
  void publish(const std::string& topic, std::vector<Pointer> SessionStart::*messages) {
    using Message = std::remove_const_t<typename Pointer::element_type>;
    const ros::SubscriberStatusCallback give = [this, topic,
                                                messages](const ros::SingleSubscriberPublisher& subscriber) {
      const SessionStart known = knownOn(topic);
      for (const Pointer& message : known.*messages) subscriber.publish(*message);
      if (subscriber.getSubscriberName() == guard_) given_.insert(topic);
    };
    publishers_.push_back(node_.advertise<Message>(topic, kQueue, give));
  }

  /// Returns whether the guard has got the messages of a topic.
  bool hasGiven(const std::string& topic) const { return given_.count(topic) > 0; }

  /// From now on, a new subscriber gets what counts at its time of meshes and static transforms, and nothing of other topics.
  void beginToPlay() { playing_ = true; }

 private:
  static constexpr std::uint32_t kQueue = 100000;

  SessionStart knownOn(const std::string& topic) const;

  const SessionFiles& files_;
  const SessionTopics topics_;
  const std::string guard_;
  const SessionStart start_;
  bool playing_ = false;
  std::set<std::string> given_;  // topics
  ros::NodeHandle node_;
  std::vector<ros::Publisher> publishers_;
};

}  // namespace sweep_guard_session
