#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <thread>

#include "common/guarded_by.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Calls functions periodically on the steady clock, in one thread. Nothing stops a timer: one of roscpp is lost if there
/// is no memory to schedule its next call. The thread rests between calls, however late they are: one with a real-time
/// priority never takes the whole processor.
class TimerThread {
 public:
  /// A function and its period. Calls that come late are not made up for.
  class Timer {
   public:
    Timer(sweep_guard_core::Duration period, std::function<void()> call) : period_(period), call_(std::move(call)) {}
    void setPeriod(sweep_guard_core::Duration period) { period_ = period; }  ///< from the newest call on. Any thread

   private:
    friend TimerThread;
    std::atomic<sweep_guard_core::Duration> period_;
    const std::function<void()> call_;
    sweep_guard_core::SteadyTime called_;
  };

  TimerThread() = default;
  ~TimerThread() { stop(); }
  TimerThread(const TimerThread&) = delete;
  TimerThread& operator=(const TimerThread&) = delete;

  /// Returns a new timer, which lives as long as the thread. Not after start().
  Timer& every(sweep_guard_core::Duration period, std::function<void()> call);
  /// Starts the thread; the supervisor must outlive it.
  /// @param prepare  called once by the thread before all else; may be empty
  void start(Supervisor& supervisor, const ThreadTraits& traits, std::function<void()> prepare = {});
  void stop();  ///< waits for the running call

 private:
  void run();
  sweep_guard_core::SteadyTime callDue();

  std::deque<Timer> timers_;
  std::function<void()> prepare_;
  ThreadTop* top_ = nullptr;
  sweep_guard_core::Mutex mutex_;
  std::condition_variable_any stopped_;
  bool stopping_ GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
