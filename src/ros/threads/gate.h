#pragma once

#include <functional>
#include <utility>

#include "common/guarded_by.h"

namespace sweep_guard_ros {

/// Passes calls on to a callback until it is closed. Any thread.
template <typename... Args>
class Gate {
 public:
  explicit Gate(std::function<void(Args...)> callback) : callback_(std::move(callback)) {}

  void pass(Args... args) {
    const sweep_guard_core::Lock lock(mutex_);
    if (callback_) callback_(args...);
  }

  void close() {  ///< waits for a call that is being passed on
    const sweep_guard_core::Lock lock(mutex_);
    callback_ = nullptr;
  }

 private:
  sweep_guard_core::Mutex mutex_;
  std::function<void(Args...)> callback_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_ros
