#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_recording {

/// Collects the time intervals that a guard has swept: one for each Contacts message. A pose that was swept together
/// with a later one has no message of its own and lies within the interval of the later one.
class SweptIntervals {
 public:
  /// Adds an interval.
  /// @param start  stamp of the previous pose; equal to `stamp` if there is none
  /// @param stamp  stamp of the pose; not earlier than those added before
  void add(sweep_guard_core::Time start, sweep_guard_core::Time stamp) {
    if (size_++ > 0 && start > *last()) gaps_ += start - *last();
    const auto interval = start_of_.try_emplace(stamp, start).first;
    interval->second = std::min(interval->second, start);
    longest_ = std::max(longest_, stamp - interval->second);
  }

  std::size_t size() const { return size_; }
  /// Returns whether a pose with this stamp was swept. The pose at the start belongs to the previous interval.
  bool covers(sweep_guard_core::Time stamp) const {
    const auto interval = start_of_.lower_bound(stamp);
    return interval != start_of_.end() && (interval->first == stamp || interval->second < stamp);
  }
  sweep_guard_core::Duration gaps() const { return gaps_; }        ///< total time between the intervals
  sweep_guard_core::Duration longest() const { return longest_; }  ///< of all intervals
  /// Returns the stamp of the first pose swept; empty: none.
  std::optional<sweep_guard_core::Time> first() const {
    return start_of_.empty() ? std::nullopt : std::optional(start_of_.begin()->first);
  }
  /// Returns the stamp of the last pose swept; empty: none.
  std::optional<sweep_guard_core::Time> last() const {
    return start_of_.empty() ? std::nullopt : std::optional(start_of_.rbegin()->first);
  }

 private:
  std::map<sweep_guard_core::Time, sweep_guard_core::Time> start_of_;  // by the stamp at the end
  std::size_t size_ = 0;
  sweep_guard_core::Duration gaps_{0};
  sweep_guard_core::Duration longest_{0};
};

}  // namespace sweep_guard_recording
