#pragma once

#include <ros/console.h>

#include <chrono>
#include <map>
#include <string>

namespace sweep_guard_ros {

/// Logs an error at once, and then once a second with what it swallowed: for each key apart, on the steady clock.
/// (roscpp's own throttle is silent while ROS time stands still, just when something is wrong.) One thread.
class LogThrottle {
 public:
  void error(const std::string& key, const std::string& text) {
    if (entries_.size() >= 64) entries_.clear();  // made-up keys must not fill the memory
    Entry& entry = entries_[key];
    const auto now = std::chrono::steady_clock::now();
    if (entry.logged && now - entry.last < std::chrono::seconds(1)) {
      ++entry.swallowed;
      return;
    }
    const std::string more = entry.swallowed == 0 ? "" : " (and " + std::to_string(entry.swallowed) + " more)";
    ROS_ERROR("%s%s", text.c_str(), more.c_str());
    entry = {true, now, 0};
  }

 private:
  struct Entry {
    bool logged = false;
    std::chrono::steady_clock::time_point last;
    int swallowed = 0;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace sweep_guard_ros
