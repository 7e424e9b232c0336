#pragma once

#include <array>
#include <atomic>
#include <deque>
#include <functional>
#include <thread>

#include "common/guarded_by.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/stall_timer.h"
#include "ros/threads/thread_top.h"

namespace sweep_guard_ros {

/// Whose process the guard runs in. Only its own may end, so that it is started again.
enum class Process { kOwn, kShared };

constexpr int kFailedStatus = 4;  ///< exit status after repeated exceptions

/// Watches the threads of one guard. An exception at the top of a thread is reported; the third within 10 s ends the
/// guard's own process with kFailedStatus. A thread that works without progress for 150 ms of its own time is named by
/// hung(); after 2 s the guard's own process aborts. The thread that watches takes no lock.
class Supervisor {
 public:
  /// @param failed  called after each exception at the top of a thread, in that thread. What it throws is ignored
  using Failed = std::function<void(const char* what, const ThreadTraits& thread)>;
  explicit Supervisor(
      Process process, Failed failed = [](const char*, const ThreadTraits&) {});
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Returns the top of a new thread, which lives as long as the supervisor. Not after start().
  ThreadTop& add(const ThreadTraits& thread);
  void start();  ///< begins to watch
  /// Returns how long all threads together were in each stage, since start(). Any thread.
  sweep_guard_core::StageTimes stageTimes() const;
  /// Returns the name of a thread that hangs; null: none. Any thread.
  const char* hung() const { return hung_; }

 private:
  friend ThreadTop;
  struct Watched {
    Watched(Supervisor& supervisor, const ThreadTraits& thread) : top(supervisor, thread) {}
    ThreadTop top;
    StallTimer stall;
    std::optional<std::uint64_t> steps;  // newest, as the state
    ThreadState state{};
  };

  void failed(const ThreadTraits& thread, const char* what) noexcept;
  bool repeated() noexcept;
  void watch();
  static bool blames(const Watched& one, const Watched& other);
  void check(sweep_guard_core::Duration since_last);

  const Process process_;
  const Failed failed_;
  std::deque<Watched> threads_;
  std::atomic<const char*> hung_ = nullptr;
  LogThrottle log_;
  sweep_guard_core::Mutex failures_mutex_;
  std::array<sweep_guard_core::SteadyTime, 2> failures_
      GUARDED_BY(failures_mutex_){};  // the newest before this one, the latest first
  std::atomic<bool> started_ = false;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
