#pragma once

#include <atomic>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "ros/publisher_links.h"
#include "ros/threads/timer_thread.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Connects the inputs anew to publishers that were out of reach. Without it they stay silent after a broken link is
/// whole again, for up to as long as it was broken: that is how long TCP waits until it sends again. Also connects
/// publishers that the master knows and roscpp has given up: it does so for good when one announces a message of over a
/// gigabyte. Looks only while an input or a transform is missing or stale, or the guard is disabled; in a thread of its
/// own.
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
  void connectAnew(const std::string& publisher, const std::map<std::string, Publishers>& topics);
  void connectPending();
  void connectGivenUp(const std::map<std::string, Publishers>& connected);
  std::optional<std::map<std::string, Publishers>> findNotConnected(
      const std::map<std::string, Publishers>& connected) const;

  const sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::Warning warning_;
  std::atomic<bool> stopping_ = false;
  const XmlRpcCall call_;
  std::set<std::string> out_of_reach_;
  std::map<std::string, Publishers> pending_;        // by topic: disconnected, and to be connected again
  std::map<std::string, Publishers> not_connected_;  // by topic, a while ago
  sweep_guard_core::SteadyTime next_question_{};     // to the master
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
