#pragma once

#include <atomic>
#include <functional>
#include <utility>

#include "ros/connection/xml_rpc_call.h"
#include "ros/threads/timer_thread.h"

namespace sweep_guard_ros {

/// The thread of a node that calls the ROS master and other nodes, periodically: they may not answer for long.
class MasterThread {
 public:
  MasterThread() : call_(kCallTimeout, stopping_) {}
  ~MasterThread() { stop(); }
  MasterThread(const MasterThread&) = delete;
  MasterThread& operator=(const MasterThread&) = delete;

  /// Calls `work` periodically until stop(). Not after start().
  void every(sweep_guard_core::Duration period, std::function<void()> work) { thread_.every(period, std::move(work)); }
  const XmlRpcCall& call() const { return call_; }  ///< in any thread. Gives up once this is stopped
  const std::atomic<bool>& stopping() const { return stopping_; }

  /// Starts the thread; the supervisor must outlive it.
  void start(Supervisor& supervisor) {
    thread_.start(supervisor, {"master", sweep_guard_core::Stage::kOther, /*watched=*/false});
  }
  void stop() {  ///< ends the running call, and waits for its end
    stopping_ = true;
    thread_.stop();
  }

 private:
  std::atomic<bool> stopping_ = false;
  const XmlRpcCall call_;
  TimerThread thread_;
};

}  // namespace sweep_guard_ros
