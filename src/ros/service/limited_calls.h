#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include "ros/connection/bounded.h"
#include "ros/threads/queue_thread.h"

namespace sweep_guard_ros {

constexpr size_t kMaxRequest = 1024;  ///< [bytes]; of a request that holds little more than names
constexpr auto kTransformWait = std::chrono::milliseconds(100);  ///< of a call for a transform
constexpr auto kGuardTimeout = std::chrono::seconds(1);          ///< of a call for a guard that is stuck in a sweep

/// Runs the calls of services in a thread of their own. At most 4 calls wait there while one runs. Any more are answered
/// BUSY at once, in a second thread. The servers must be destroyed first.
class LimitedCalls : public ros::CallbackQueueInterface {
 public:
  static constexpr int kMaxWaiting = 4;

  /// @param name  of the thread: at most 15 bytes; lives as long as the process
  explicit LimitedCalls(const char* name);

  /// Advertises a service. Its requests are checked before memory is reserved for them.
  /// @param max_size  of a request [bytes]
  /// @param refused   as for advertiseBounded(); the reason may be that there is no room
  template <typename Spec>
  ros::ServiceServer advertise(ros::NodeHandle node, const std::string& name, size_t max_size,
                               typename BoundedCalls<Spec>::Base::Callback callback,
                               typename BoundedCalls<Spec>::Refused refused) {
    node.setCallbackQueue(this);
    return advertiseBounded<Spec>(node, name, max_size, std::move(callback), std::move(refused), throwIfBusy);
  }
  /// Starts both threads; the supervisor must outlive them.
  void start(Supervisor& supervisor);

  /// Throws sweep_guard_core::Error in a call that found no room.
  static void throwIfBusy();
  /// Returns when the running call came: it may have waited since. Only in a call that found room.
  static std::chrono::steady_clock::time_point arrival();

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
  void removeByID(std::uint64_t owner) override;

 private:
  const char* const name_;
  const std::shared_ptr<std::atomic<int>> inside_ = std::make_shared<std::atomic<int>>(0);  // one runs, others wait
  QueueThread worker_;
  QueueThread refusals_;
};

}  // namespace sweep_guard_ros
