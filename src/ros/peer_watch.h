#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "ros/threads/supervisor.h"
#include "ros/xml_rpc_call.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Connects the inputs anew to publishers that were out of reach. Without it they stay silent after a broken link is
/// whole again, for up to as long as it was broken: that is how long TCP waits until it sends again. Looks only while an
/// input is stale, in a thread of its own.
class PeerWatch {
 public:
  explicit PeerWatch(const sweep_guard_core::WarningMonitor& monitor);
  ~PeerWatch();
  PeerWatch(const PeerWatch&) = delete;
  PeerWatch& operator=(const PeerWatch&) = delete;

  void start(Supervisor& supervisor);

 private:
  using Topics = std::map<std::string, std::set<std::string>>;  // addresses of publishers by topic

  void run();
  void checkOrLog();
  void check();
  bool inputIsStale();
  Topics connections() const;
  void connectAnew(const std::string& publisher, const Topics& connections) const;
  void setPublishers(const std::string& topic, const std::set<std::string>& publishers) const;

  const sweep_guard_core::WarningMonitor& monitor_;
  sweep_guard_core::Warning warning_;
  std::atomic<bool> stopping_ = false;
  const XmlRpcCall call_;
  std::set<std::string> out_of_reach_;
  std::mutex mutex_;
  std::condition_variable changed_;
  ThreadTop* top_ = nullptr;  // from start() on
  std::thread thread_;
};

}  // namespace sweep_guard_ros
