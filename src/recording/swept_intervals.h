#pragma once

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
  void add(sweep_guard_core::Time start, sweep_guard_core::Time stamp);

  std::size_t size() const { return size_; }
  bool covers(sweep_guard_core::Time stamp) const;           ///< whether a pose with this stamp was swept
  sweep_guard_core::Duration gaps() const { return gaps_; }  ///< total time between the intervals
  std::optional<sweep_guard_core::Time> first() const;       ///< stamp of the first pose swept; empty: none
  std::optional<sweep_guard_core::Time> last() const;        ///< stamp of the last pose swept; empty: none

 private:
  std::map<sweep_guard_core::Time, sweep_guard_core::Time> start_of_;  // by the stamp at the end
  std::size_t size_ = 0;
  sweep_guard_core::Duration gaps_{0};
};

}  // namespace sweep_guard_recording
