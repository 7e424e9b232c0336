#pragma once

#include <ros/console.h>

#include <chrono>
#include <map>
#include <string>

namespace sweep_guard_ros {

/// Logs an error at once, and then at most once per second and key, with the number of suppressed ones. Uses the steady
/// clock: roscpp's own throttle is silent while ROS time stands still. One thread.
class LogThrottle {
 public:
  void error(const std::string& key, const std::string& text) {
    if (entries_.size() >= 64) entries_.clear();  // bounds the memory that made-up keys can take
    Entry& entry = entries_[key];
    const auto now = std::chrono::steady_clock::now();
    if (entry.logged && now - entry.last < std::chrono::seconds(1)) {
      ++entry.suppressed;
      return;
    }
    const std::string more = entry.suppressed == 0 ? "" : " (and " + std::to_string(entry.suppressed) + " more)";
    ROS_ERROR("%s%s", text.c_str(), more.c_str());
    entry = {true, now, 0};
  }

 private:
  struct Entry {
    bool logged = false;
    std::chrono::steady_clock::time_point last;
    int suppressed = 0;
  };
  std::map<std::string, Entry> entries_;
};

}  // namespace sweep_guard_ros
