#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_ros {

/// What came in by one input, and what was wrong with it. Any thread.
class InputRecord {
 public:
  struct Summary {
    std::uint64_t received = 0;                          ///< messages, refused ones too
    std::uint64_t refused = 0;                           ///< of them
    std::optional<sweep_guard_core::Timestamps> newest;  ///< message; empty: none yet
    std::string last_error;                              ///< empty: there was none
    sweep_guard_core::SteadyTime failed;                 ///< when that was
  };

  void came(const sweep_guard_core::Timestamps& message) {
    const std::lock_guard lock(mutex_);
    ++summary_.received;
    summary_.newest = message;
  }

  /// Something is wrong around a message that counts all the same.
  void failed(const std::string& why) {
    const std::lock_guard lock(mutex_);
    summary_.last_error = why;
    summary_.failed = std::chrono::steady_clock::now();
  }

  void refused(const std::string& why) {
    failed(why);
    const std::lock_guard lock(mutex_);
    ++summary_.refused;
  }

  Summary summary() const {
    const std::lock_guard lock(mutex_);
    return summary_;
  }

 private:
  mutable std::mutex mutex_;
  Summary summary_;
};

}  // namespace sweep_guard_ros
