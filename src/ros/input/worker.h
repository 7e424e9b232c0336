#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <thread>

#include "common/guarded_by.h"
#include "ros/threads/supervisor.h"

namespace sweep_guard_ros {

/// Runs jobs in a thread of its own, in their order. The jobs that wait hold a bounded number of bytes.
class Worker {
 public:
  struct Job {
    std::function<void()> run;
    /// Called instead if there is no room, before the job that needs the room is pushed; also after `run` has thrown.
    std::function<void()> drop;
    size_t bytes;              ///< held until the job runs
    bool replaceable = false;  ///< later jobs bring newer data: takes no room from jobs that are not replaceable
  };

  /// @param max_bytes  of all jobs that wait; the newest may always wait
  explicit Worker(size_t max_bytes) : max_bytes_(max_bytes) {}
  ~Worker();  ///< waits for the running job and forgets the others
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void start(Supervisor& supervisor, const ThreadTraits& traits);  ///< the supervisor must outlive it
  /// Drops the oldest of the waiting jobs as long as the job does not fit beside them, replaceable ones first. A
  /// replaceable job that would take the room of others is dropped itself.
  void push(Job job);

 private:
  void run();
  static void runOrDrop(const Job& job);
  std::deque<Job>::iterator nextToDrop() REQUIRES(mutex_);

  const size_t max_bytes_;
  sweep_guard_core::Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Job> jobs_ GUARDED_BY(mutex_);
  size_t bytes_ GUARDED_BY(mutex_) = 0;  // of jobs_
  bool stopping_ GUARDED_BY(mutex_) = false;
  ThreadTop* top_ = nullptr;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
