#pragma once

#include <atomic>
#include <map>
#include <set>
#include <string>

#include "ros/publisher_links.h"
#include "ros/threads/timer_thread.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Connects the inputs anew to publishers that were out of reach. Without it they stay silent after a broken link is
/// whole again, for up to as long as it was broken: that is how long TCP waits until it sends again. Looks only while an
/// input or a transform is missing or stale, or the guard is disabled; in a thread of its own.
class PeerWatch {
 public:
  explicit PeerWatch(const sweep_guard_core::WarningMonitor& monitor);
  ~PeerWatch();
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

  void start(Supervisor& supervisor) {
    thread_.start(supervisor, {"peers", sweep_guard_core::Stage::kOther, /*watched=*/false});
  }

 private:
  void checkOrLog();
  void check();
  bool inputMayBeSilent();
  void connectAnew(const std::string& publisher, const PublishersOfTopics& topics);
  void connectPending();

  const sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::Warning warning_;
  std::atomic<bool> stopping_ = false;
  const XmlRpcCall call_;
  std::set<std::string> out_of_reach_;
  PublishersOfTopics pending_;  // by topic: disconnected, and to be connected again
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
