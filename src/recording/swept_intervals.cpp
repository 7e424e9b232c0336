#include "recording/swept_intervals.h"

#include <algorithm>

namespace sweep_guard_recording {

using sweep_guard_core::Time;

void SweptIntervals::add(Time start, Time stamp) {
  if (size_++ > 0 && start > *last()) gaps_ += start - *last();
  const auto interval = start_of_.try_emplace(stamp, start).first;
  interval->second = std::min(interval->second, start);
}

// The pose at the start belongs to the previous interval.
bool SweptIntervals::covers(Time stamp) const {
  const auto interval = start_of_.lower_bound(stamp);
  return interval != start_of_.end() && (interval->first == stamp || interval->second < stamp);
}

std::optional<Time> SweptIntervals::first() const {
  return start_of_.empty() ? std::nullopt : std::optional(start_of_.begin()->first);
}

std::optional<Time> SweptIntervals::last() const {
  return start_of_.empty() ? std::nullopt : std::optional(start_of_.rbegin()->first);
}

}  // namespace sweep_guard_recording
