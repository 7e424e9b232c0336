#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <thread>

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

  /// Runs the work there and waits for its end. One caller at a time; it must have returned before the destructor.
  /// @throws what the work throws
  void run(std::function<void()> work);

 private:
  void loop();

  void (*const lower_)();
  ThreadTop* top_ = nullptr;  // from start() on
  std::mutex mutex_;
  std::condition_variable changed_;
  std::packaged_task<void()> work_;  // valid while it waits to be run
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
