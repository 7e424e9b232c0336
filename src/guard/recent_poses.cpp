#include "guard/recent_poses.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr Duration kRecent = std::chrono::seconds(1);
constexpr size_t kMostPoses = 4096;

}  // namespace

void RecentPoses::add(Time stamp, const BodyPoses& bodies) {
  {
    const Lock lock(mutex_);
    if (!poses_.empty() && stamp < poses_.back().first) poses_.clear();
    while (!poses_.empty() && poses_.front().first + kRecent < stamp) poses_.pop_front();
    if (poses_.full() && poses_.capacity() < kMostPoses) poses_.set_capacity(2 * poses_.capacity());
    poses_.push_back({stamp, bodies});
  }
  added_.notify_all();
}

std::optional<std::pair<BodyPoses, BodyPoses>> RecentPoses::around(Time stamp, Duration wait) const {
  const SteadyTime end = std::chrono::steady_clock::now() + wait;
  Lock lock(mutex_);
  while (poses_.empty() || poses_.back().first < stamp) {
    if (added_.wait_until(lock, end) == std::cv_status::timeout) break;
  }
  const auto later = [](Time time, const auto& pose) { return time < pose.first; };
  const auto next = std::upper_bound(poses_.begin(), poses_.end(), stamp, later);
  if (next == poses_.begin()) return std::nullopt;
  const auto& before = *std::prev(next);
  if (next != poses_.end()) return std::pair(before.second, next->second);
  return before.first == stamp ? std::optional(std::pair(before.second, before.second)) : std::nullopt;
}

}  // namespace sweep_guard_core
