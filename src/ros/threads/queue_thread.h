#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <thread>

#include "ros/threads/supervisor.h"

namespace sweep_guard_ros {

/// Runs the callbacks of one queue in one thread, so that no input waits for another. Callbacks wait until start().
/// Subscribers and services made from it must be destroyed first; what their callbacks use, after stop() or later: roscpp
/// does not wait for a callback that runs.
class QueueThread : private ros::CallbackQueue {
 public:
  QueueThread() = default;
  ~QueueThread() override { stop(); }
  QueueThread(const QueueThread&) = delete;
  QueueThread& operator=(const QueueThread&) = delete;

  /// Returns a node handle whose callbacks run in this thread.
  ros::NodeHandle on(ros::NodeHandle node);

  ros::CallbackQueue& queue() { return *this; }
  /// Queues work between the callbacks. Any thread.
  void post(std::function<void()> work);
  /// Starts the thread; the supervisor must outlive it.
  void start(Supervisor& supervisor, const ThreadTraits& traits);
  void stop();  ///< waits for the running callback, and runs no more
  /// Returns whether the calling thread is this one.
  bool isCurrent() const { return id_ == std::this_thread::get_id(); }

 private:
  class Work;

  // Runs each callback as a piece of work of the thread's top.
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
  void run();

  ThreadTop* top_ = nullptr;  // from start() on
  std::atomic<std::thread::id> id_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
