#pragma once

#include <ros/console.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <string>

#include "common/guarded_by.h"

namespace sweep_guard_ros {

/// Logs an error at once, then less and less often while it lasts: after 1, 2, 4 ... 64 s, with the number of suppressed
/// ones. Uses the steady clock: roscpp's own throttle is silent while ROS time stands still. Any thread.
class LogThrottle {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param key  kind of the error; those beyond the first four kinds share one count, for names may be made up
  void error(const std::string& key, const std::string& text, Clock::time_point now = Clock::now()) {
    const sweep_guard_core::Lock lock(mutex_);
    const bool known = entries_.count(key) != 0 || entries_.size() < kMaxKeys;
    Entry& entry = entries_[known ? key : ""];
    if (now - entry.newest > kQuiet) entry = {};
    entry.newest = now;
    if (now < entry.next) {
      ++entry.suppressed;
      return;
    }
    const std::string more = entry.suppressed == 0 ? "" : " (and " + std::to_string(entry.suppressed) + " more)";
    ROS_ERROR("%s%s", text.c_str(), more.c_str());
    entry.next = now + entry.interval;
    entry.interval = std::min(2 * entry.interval, kMaxInterval);
    entry.suppressed = 0;
  }

 private:
  static constexpr size_t kMaxKeys = 4;
  static constexpr std::chrono::seconds kQuiet{10};
  static constexpr std::chrono::seconds kMaxInterval{64};

  struct Entry {
    Clock::time_point newest;
    Clock::time_point next;
    std::chrono::seconds interval{1};
    int suppressed = 0;
  };
  sweep_guard_core::Mutex mutex_;
  std::map<std::string, Entry> entries_ GUARDED_BY(mutex_);
};

}  // namespace sweep_guard_ros
