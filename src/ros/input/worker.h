#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace sweep_guard_ros {

/// Runs jobs in a thread of its own, in their order. The jobs that wait hold a bounded number of bytes.
class Worker {
 public:
  struct Job {
    std::function<void()> run;
    std::function<void()> drop;  ///< called instead if a job does not fit that is to be pushed, before it is pushed
    size_t bytes;                ///< held until the job runs; a job of 0 bytes is never dropped
    bool replaceable = false;    ///< later jobs bring newer data: dropped before other jobs
  };

  /// @param max_bytes  of all jobs that wait; the newest may always wait
  explicit Worker(size_t max_bytes) : max_bytes_(max_bytes) {}
  ~Worker();  ///< waits for the running job and forgets the others
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void start();
  void push(Job job);  ///< drops the oldest of the waiting jobs if it does not fit beside them

 private:
  void run();
  std::deque<Job>::iterator nextToDrop();

  const size_t max_bytes_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  size_t bytes_ = 0;  // of jobs_
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
