#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// A checked tool pose with the frames of the workpieces, and the monitor's state when it was received.
struct QueuedPose {
  sweep_guard_core::PoseWithFrames pose;
  sweep_guard_core::WarningMonitor::Checkpoint checkpoint;
};

/// Holds the work of the guard's thread: poses in their order, and tasks to run between two sweeps. Any thread.
class WorkQueue {
 public:
  struct Work {
    std::vector<std::function<void()>> tasks;
    std::vector<QueuedPose> poses;
  };

  void push(QueuedPose pose);  ///< waits while the queue is full

  /// Queues a task and returns its result to come.
  /// @throws sweep_guard_core::Error if too many tasks are queued, or after stop()
  template <typename Result>
  std::future<Result> submit(std::function<Result()> task) {
    const auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(task));
    pushTask([packaged] { (*packaged)(); });
    return packaged->get_future();
  }

  /// Waits for work, and takes all of it.
  /// @param[out] taken  overwritten
  /// @returns false after stop()
  bool take(Work& taken);
  bool hasPoses() const;

  /// Drops all work and ends every wait. A dropped task's future throws std::future_error.
  void stop();

 private:
  void pushTask(std::function<void()> task);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Work work_;
  bool stopping_ = false;
};

}  // namespace sweep_guard_ros
