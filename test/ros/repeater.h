#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace sweep_guard_ros {

/// Calls a function periodically in a thread of its own. Its end waits for the running call, which that of a roscpp timer
/// does not.
class Repeater {
 public:
  Repeater(std::chrono::milliseconds period, std::function<void()> call)
      : period_(period), call_(std::move(call)), thread_([this] { run(); }) {}

  ~Repeater() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

 private:
  void run() {
    auto next = std::chrono::steady_clock::now() + period_;
    std::unique_lock lock(mutex_);
    while (!changed_.wait_until(lock, next, [this] { return ending_; })) {
      lock.unlock();
      call_();
      next = std::max(next + period_, std::chrono::steady_clock::now());
      lock.lock();
    }
  }

  const std::chrono::milliseconds period_;
  const std::function<void()> call_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
