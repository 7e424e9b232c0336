#include "guard/recent_poses.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr Duration kRecent = std::chrono::seconds(1);

}  // namespace

void RecentPoses::add(Time stamp, const BodyPoses& bodies) {
  const Lock lock(mutex_);
  if (!poses_.empty() && stamp < poses_.back().first) poses_.clear();
  while (!poses_.empty() && poses_.front().first + kRecent < stamp) poses_.pop_front();
  poses_.emplace_back(stamp, bodies);
}

std::optional<std::pair<BodyPoses, BodyPoses>> RecentPoses::around(Time stamp) const {
  const Lock lock(mutex_);
  const auto later = [](Time time, const auto& pose) { return time < pose.first; };
  const auto next = std::upper_bound(poses_.begin(), poses_.end(), stamp, later);
  if (next == poses_.begin()) return std::nullopt;
  const BodyPoses& before = std::prev(next)->second;
  return std::pair(before, next == poses_.end() ? before : next->second);
}

}  // namespace sweep_guard_core
