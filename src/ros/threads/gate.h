#pragma once

#include <functional>
#include <mutex>
#include <utility>

namespace sweep_guard_ros {

/// Passes calls on to a callback until it is closed. Any thread.
template <typename... Args>
class Gate {
 public:
  explicit Gate(std::function<void(Args...)> callback) : callback_(std::move(callback)) {}

  void pass(Args... args) {
    const std::lock_guard lock(mutex_);
    if (callback_) callback_(args...);
  }

  void close() {  ///< waits for a call that is being passed on
    const std::lock_guard lock(mutex_);
    callback_ = nullptr;
  }

 private:
  std::mutex mutex_;
  std::function<void(Args...)> callback_;
};

}  // namespace sweep_guard_ros
