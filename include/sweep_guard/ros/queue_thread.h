#pragma once

#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <atomic>
#include <thread>

namespace sweep_guard_ros {

/// Runs the callbacks of one queue in one thread, so that no input waits for another. Callbacks wait until start().
/// Subscribers and services made from on() must be destroyed first.
class QueueThread {
 public:
  QueueThread() = default;
  /// Wakes the thread: ros::AsyncSpinner would wait for up to 0.1 s.
  ~QueueThread() {
    stopping_ = true;
    queue_.disable();
    if (thread_.joinable()) thread_.join();
  }
  QueueThread(const QueueThread&) = delete;
  QueueThread& operator=(const QueueThread&) = delete;

  /// Returns a node handle whose callbacks run in this thread.
  ros::NodeHandle on(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }

  ros::CallbackQueue& queue() { return queue_; }
  void start() {
    thread_ = std::thread([this] { run(); });
  }

 private:
  void run() {
    while (!stopping_ && !ros::isShuttingDown()) queue_.callOne(ros::WallDuration(0.1));
  }

  ros::CallbackQueue queue_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
