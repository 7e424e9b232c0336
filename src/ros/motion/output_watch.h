#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "ros/connection/xml_rpc_call.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// Asks the master once a second, in a thread of its own, which other nodes publish a topic of this node. It does not see
/// other nodelets of its own manager.
class OutputWatch {
 public:
  explicit OutputWatch(std::string topic);
  ~OutputWatch();
  OutputWatch(const OutputWatch&) = delete;
  OutputWatch& operator=(const OutputWatch&) = delete;

  void start(Supervisor& supervisor) {
    thread_.start(supervisor, {"output watch", sweep_guard_core::Stage::kOther, /*watched=*/false});
  }

  const std::string& topic() const { return topic_; }
  std::vector<std::string> otherPublishers() const;  ///< names of nodes, as of the newest answer. Any thread

 private:
  void check();

  const std::string topic_;
  std::atomic<bool> stopping_ = false;
  const XmlRpcCall call_;
  mutable sweep_guard_core::Mutex mutex_;
  std::vector<std::string> others_ GUARDED_BY(mutex_);
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
