#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "ros/input/pose_input.h"

namespace sweep_guard_ros {

/// What waits for the thread that sweeps: poses in their order, and tasks to be done between two sweeps.
class WorkQueue {
 public:
  struct Work {
    std::vector<std::function<void()>> tasks;
    std::vector<QueuedPose> poses;
  };

  void push(QueuedPose pose);  ///< waits while there is no room

  /// @throws sweep_guard_core::Error if too many tasks wait already, or after stop()
  template <typename Result>
  std::future<Result> ask(std::function<Result()> task) {
    const auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(task));
    pushTask([packaged] { (*packaged)(); });
    return packaged->get_future();
  }

  /// All there is, as soon as there is any, instead of what was taken before.
  /// @return false after stop()
  bool take(Work& taken);
  bool noPoseWaits() const;

  void stop();  ///< lets everybody go; whoever waits for a task hears that it is not done

 private:
  void pushTask(std::function<void()> task);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Work work_;
  bool stopping_ = false;
};

}  // namespace sweep_guard_ros
