#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "ros/connection/publisher_links.h"
#include "ros/connection/xml_rpc_call.h"
#include "ros/input/worker.h"
#include "ros/scene/raw_messages.h"
#include "ros/scene/scene_reader.h"
#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {

/// Reads the messages of one topic in a thread of its own, by the definition that their publisher sends with them, and
/// reports what they change. What cannot be read, or is not known yet, is a refusal of the topic. It ends with a message that
/// says all, or with a new connection; for a publisher whose messages have another definition, when that one has gone.
class EnvironmentSource {
 public:
  using Apply = std::function<void(sweep_guard_core::SceneUpdate)>;
  using Refuse = std::function<void(const std::string& why)>;  ///< empty: the refusal has ended

  /// @param receiving  takes the messages from roscpp; must outlive it, and stop before
  /// @param call       must outlive it
  /// @param apply      called in the thread of the source
  /// @param refuse     called there and in that of `receiving`
  EnvironmentSource(const ros::NodeHandle& node, QueueThread& receiving, const EnvironmentTopic& topic,
                    const XmlRpcCall& call, Apply apply, Refuse refuse);

  void start(Supervisor& supervisor);
  /// Lets time pass. To be called 10 times a second, by one thread.
  /// @param publishers  those that are connected now
  /// @returns whether its workpieces are as they were: nothing waits to be read, nothing is refused, and those who
  ///     published are still there
  bool tick(const Publishers& publishers);

  struct State {
    std::string type;      ///< of the messages; empty: not known yet
    std::string refused;   ///< why the newest message, or the topic, does not count; empty: it does
    std::string left_out;  ///< what is no workpiece
    std::uint64_t received = 0;
  };
  State state() const;
  const std::string& topic() const { return topic_.topic; }  ///< resolved

 private:
  using Bytes = std::vector<std::uint8_t>;

  void push(const RawMessage& message);
  void drop();
  void receive(const Bytes& bytes, const boost::shared_ptr<ros::M_string>& header);
  bool isNew(const boost::shared_ptr<ros::M_string>& header);
  void makeUpForDropped();
  void subscribe();
  void checkTopic();
  void checkOthers();
  std::optional<ros::M_string> otherDefinition();
  void begin(const std::string& type);
  void open(const ros::M_string& header);
  void read(Wire bytes, sweep_guard_core::Time now);
  void report(sweep_guard_core::SceneUpdate update);
  void restart();
  void requestFullScene();
  void refuse(const std::string& why);
  void endRefusal();
  bool attempt(const std::function<void()>& work);

  const EnvironmentTopic topic_;
  const XmlRpcCall& call_;
  const Apply apply_;
  const Refuse refuse_;
  ros::NodeHandle node_;
  std::vector<boost::weak_ptr<ros::M_string>> connections_;  // that sent messages
  std::string md5_;                                          // of the definition
  std::optional<MessageDefinition> definition_;
  std::unique_ptr<SceneReader> reader_;
  bool needs_full_scene_ = false;
  bool has_lost_ = false;   // a message, and none since has made up for it
  Publishers unconnected_;  // at the last look
  bool has_other_ = false;  // a publisher whose messages have another definition
  int ticks_ = 0;
  Publishers publishers_;                    // at the last tick(), whose thread alone uses it
  std::atomic<bool> has_publisher_ = false;  // at the last tick()
  std::atomic<bool> restarts_ = false;       // a publisher has gone
  std::atomic<bool> is_known_ = false;       // a message came since
  std::atomic<bool> tick_pending_ = false;   // the thread of the source has not come to the last tick()
  std::atomic<bool> has_dropped_ = false;    // a message, which makeUpForDropped() has not seen yet
  mutable sweep_guard_core::Mutex mutex_;
  State state_ GUARDED_BY(mutex_);
  QueueThread& receiving_;
  Worker worker_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_ros
