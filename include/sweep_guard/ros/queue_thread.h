#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

namespace sweep_guard_ros {

/// Runs the callbacks of one queue in a thread of its own, one at a time, so that no queue waits for another. Callbacks
/// wait until start(). Subscribers and services made from on() must be destroyed first. The destructor waits for a
/// running callback.
class QueueThread {
 public:
  /// Returns a copy of the node handle whose callbacks run in this thread.
  ros::NodeHandle on(ros::NodeHandle node) {
    node.setCallbackQueue(&queue_);
    return node;
  }

  ros::CallbackQueue& queue() { return queue_; }
  void start() { spinner_.start(); }

 private:
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace sweep_guard_ros
