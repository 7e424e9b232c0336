#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include "common/guarded_by.h"
#include "ros/threads/supervisor.h"

namespace sweep_guard_ros {

/// A thread of low priority, for computations that others wait for. Nothing that holds a lock belongs here: a thread of low
/// priority that is preempted keeps it. roscpp's own thread does not even wait for a connection's lock, it spins.
class BackgroundThread {
 public:
  /// @param lower  called first: lowers the priority of the calling thread
  explicit BackgroundThread(void (*lower)()) : lower_(lower) {}
  ~BackgroundThread();
  BackgroundThread(const BackgroundThread&) = delete;
  BackgroundThread& operator=(const BackgroundThread&) = delete;

  /// Starts the thread; the supervisor must outlive it.
  void start(Supervisor& supervisor, const ThreadTraits& traits);

  /// Runs the work there after the work that runs, and instead of any that waits. Nobody has to wait for the result.
  template <typename Result>
  std::future<Result> submit(std::function<Result()> work) {
    const auto packaged = std::make_shared<std::packaged_task<Result()>>(std::move(work));
    replace([packaged] { (*packaged)(); });
    return packaged->get_future();
  }

 private:
  void replace(std::function<void()> work);
  void loop();

  void (*const lower_)();
  ThreadTop* top_ = nullptr;  // from start() on
  sweep_guard_core::Mutex mutex_;
  std::condition_variable_any changed_;
  std::function<void()> work_ GUARDED_BY(mutex_);  // waits to be run
  bool stopping_ GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
