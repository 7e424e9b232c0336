#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/guarded_by.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Counts the messages of one input and keeps its last error. Any thread.
class InputRecord {
 public:
  struct Summary {
    std::uint64_t received = 0;        ///< messages, including refused ones
    std::uint64_t refused = 0;         ///< messages
    std::optional<Timestamps> newest;  ///< newest message; empty: none yet
    std::string last_error;            ///< empty: none
    SteadyTime error_time;             ///< time of the last error
    std::string last_warning = {};     ///< of an anomaly without consequences; empty: none
    SteadyTime warning_time = {};      ///< time of the last warning
    std::string lacking = {};          ///< why the newest inputs are incomplete; empty: they are not
  };

  void received(const Timestamps& message) {
    const Lock lock(mutex_);
    ++summary_.received;
    summary_.newest = message;
    summary_.lacking.clear();
  }

  /// @param refused  false if the error does not refuse a message
  void error(const std::string& reason, bool refused) {
    const Lock lock(mutex_);
    summary_.refused += refused ? 1 : 0;
    summary_.last_error = reason;
    summary_.error_time = std::chrono::steady_clock::now();
  }

  void warn(const std::string& warning) {
    const Lock lock(mutex_);
    summary_.last_warning = warning;
    summary_.warning_time = std::chrono::steady_clock::now();
  }

  void lacks(const std::string& what) {
    const Lock lock(mutex_);
    summary_.lacking = what;
  }

  Summary summary() const {
    const Lock lock(mutex_);
    return summary_;
  }

 private:
  mutable Mutex mutex_;
  Summary summary_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_core
