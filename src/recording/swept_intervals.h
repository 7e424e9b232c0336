#pragma once

#include <cstddef>
#include <map>
#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_recording {

/// The time that a guard has swept, as its Contacts tell: an interval for each pose that it stopped at. A pose that had
/// to wait has no Contacts of its own, but lies within the interval of a later one.
class SweptIntervals {
 public:
  /// @param start  stamp of the pose before; equal to `stamp` where there was none
  /// @param stamp  of the pose; not before those added
  void add(sweep_guard_core::Time start, sweep_guard_core::Time stamp);

  std::size_t size() const { return size_; }
  bool cover(sweep_guard_core::Time stamp) const;              ///< a pose of that stamp was swept, or swept through
  sweep_guard_core::Duration holes() const { return holes_; }  ///< between the intervals, in sum
  std::optional<sweep_guard_core::Time> first() const;         ///< stamp of the first pose swept
  std::optional<sweep_guard_core::Time> last() const;          ///< stamp of the last one

 private:
  std::map<sweep_guard_core::Time, sweep_guard_core::Time> start_of_;  // by the stamp that it ends with
  std::size_t size_ = 0;
  sweep_guard_core::Duration holes_{0};
};

}  // namespace sweep_guard_recording
