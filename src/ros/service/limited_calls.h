#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <chrono>
#include <memory>

#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {

/// Runs the calls of services in a thread of their own. At most 4 calls wait there while one runs. Any more run at once
/// in a second thread, where refused() is true. The server made from on() must be destroyed first.
class LimitedCalls : public ros::CallbackQueueInterface {
 public:
  static constexpr int kMaxWaiting = 4;

  LimitedCalls();

  /// Returns a node handle whose calls run in these threads.
  ros::NodeHandle on(ros::NodeHandle node) {
    node.setCallbackQueue(this);
    return node;
  }
  /// Starts both threads; the supervisor must outlive them.
  void start(Supervisor& supervisor);

  /// Returns whether the calling thread answers calls that found no room.
  static bool refused();
  /// Returns when the running call came: it may have waited since. Only in a call that is not refused.
  static std::chrono::steady_clock::time_point arrival();

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
  void removeByID(std::uint64_t owner) override;

 private:
  const std::shared_ptr<std::atomic<int>> inside_ = std::make_shared<std::atomic<int>>(0);  // one runs, others wait
  QueueThread worker_;
  QueueThread refusals_;
};

}  // namespace sweep_guard_ros
