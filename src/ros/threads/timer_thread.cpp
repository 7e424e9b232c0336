#include "ros/threads/timer_thread.h"

#include <algorithm>
#include <utility>

namespace sweep_guard_ros {

using sweep_guard_core::Duration;
using sweep_guard_core::SteadyTime;

namespace {

constexpr Duration kRest = std::chrono::microseconds(50);

}  // namespace

TimerThread::Timer& TimerThread::every(Duration period, std::function<void()> call) {
  return timers_.emplace_back(period, std::move(call));
}

void TimerThread::start(Supervisor& supervisor, const ThreadTraits& traits, std::function<void()> prepare) {
  prepare_ = std::move(prepare);
  top_ = &supervisor.add(traits);
  const SteadyTime now = std::chrono::steady_clock::now();
  for (Timer& timer : timers_) timer.called_ = now;
  thread_ = std::thread([this] { run(); });
}

void TimerThread::stop() {
  {
    const sweep_guard_core::Lock lock(mutex_);
    stopping_ = true;
  }
  stopped_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void TimerThread::run() {
  top_->enter();
  if (prepare_) top_->attempt(prepare_);
  sweep_guard_core::Lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    const SteadyTime due = callDue();
    const SteadyTime next = std::max(due, std::chrono::steady_clock::now() + kRest);
    lock.lock();
    while (!stopping_ && stopped_.wait_until(lock, next) == std::cv_status::no_timeout) continue;
  }
}

// Returns when the next call is due.
SteadyTime TimerThread::callDue() {
  SteadyTime next = SteadyTime::max();
  for (Timer& timer : timers_) {
    const SteadyTime now = std::chrono::steady_clock::now();
    const Duration period = timer.period_;
    if (timer.called_ + period <= now) {
      timer.called_ = std::max(timer.called_ + period, now - period);
      top_->run(timer.call_);
    }
    next = std::min(next, timer.called_ + period);
  }
  return next;
}

}  // namespace sweep_guard_ros
