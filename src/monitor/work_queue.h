#pragma once

#include <semaphore.h>

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {

/// A checked tool pose with the frames of the workpieces, and the monitor's state when it was received.
struct QueuedPose {
  PoseWithFrames pose;
  WarningMonitor::Checkpoint checkpoint;
};

/// Holds the work of the guard's thread: poses and images in their order, and tasks to run between two batches of poses. One thread
/// takes; any thread may call the other functions. While one of these keeps the taking thread waiting, it has at least
/// that thread's priority (Mutex).
class WorkQueue {
 public:
  WorkQueue() { sem_init(&signal_, /*pshared=*/0, 0); }
  ~WorkQueue() { sem_destroy(&signal_); }
  WorkQueue(const WorkQueue&) = delete;
  WorkQueue& operator=(const WorkQueue&) = delete;

  struct Work {
    std::vector<std::function<void()>> tasks;
    std::vector<std::shared_ptr<const Workpiece>> images;  ///< Workpiece::of_camera
    std::vector<QueuedPose> poses;
    bool frames_moved = false;  ///< a frame that is followed is known further than when the work before was taken
  };

  /// Queues a pose. In a full queue it replaces the newest one.
  /// @returns false if it replaced a pose, which is then not swept
  bool push(QueuedPose pose);

  /// Queues what a camera sees.
  /// @returns false if 16 images wait, or after stop()
  bool show(std::shared_ptr<const Workpiece> image);

  /// Reports that a frame that is followed is known further.
  void framesMoved();

  /// Queues a task and returns its result to come.
  /// @throws Error if too many tasks are queued, or after stop()
  template <typename Result>
  std::future<Result> submit(std::function<Result()> task) {
    const auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(task));
    pushTask([packaged] { (*packaged)(); });
    return packaged->get_future();
  }

  /// Runs a task and returns when it is done.
  /// @param timeout  a task that has not begun by then is dropped: it does not run later
  /// @throws Error as submit(), or if the task was dropped; and what the task throws
  void run(const std::function<void()>& task, Duration timeout);

  /// Waits for work, which may be a frame that moved, and takes all tasks and images, and the oldest poses, at most 4096.
  /// @param[out] taken  overwritten; empty if no work came in time
  /// @param until  waits no longer; empty: as long as it takes
  /// @returns false after stop()
  bool take(Work& taken, std::optional<SteadyTime> until = {});
  /// Takes all tasks, and no poses. Does not wait.
  std::vector<std::function<void()>> takeTasks();
  /// Takes poses as take() does, and no tasks. Does not wait.
  /// @param[out] taken  overwritten
  void takePoses(std::vector<QueuedPose>& taken);
  /// Takes the images, and nothing else. Does not wait.
  std::vector<std::shared_ptr<const Workpiece>> takeImages();
  bool hasPoses() const;
  bool hasImages() const;
  bool hasWork() const;

  /// Reports that the poses taken so far are swept, except those from this one on.
  /// @param next  when the next of the taken poses was received; empty: all are swept
  void swept(std::optional<SteadyTime> next);
  /// Returns when the oldest pose that is not yet swept was received; empty: there is none.
  std::optional<SteadyTime> waitingSince() const;

  /// Drops all work and ends every wait. A dropped task's future throws std::future_error.
  void stop();
  bool stopped() const;

 private:
  void pushTask(std::function<void()> task);
  bool takeNow(Work& taken);
  bool wait(std::optional<SteadyTime> until);
  void takePosesNow(std::vector<QueuedPose>& taken) REQUIRES(mutex_);
  void wake() REQUIRES(mutex_);

  mutable Mutex mutex_;
  sem_t signal_;  // for the waiting thread: a condition variable has a lock without inheritance of priority
  bool waiting_ GUARDED_BY(mutex_) = false;  // the taking thread
  Work work_ GUARDED_BY(mutex_);
  std::optional<SteadyTime> taken_since_ GUARDED_BY(mutex_);  // of the oldest taken pose that is not yet swept
  bool stopping_ GUARDED_BY(mutex_) = false;
};

}  // namespace sweep_guard_core
