#include "ros/threads/stall_timer.h"

#include <algorithm>
#include <utility>

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;

constexpr Duration kLongestStep = std::chrono::milliseconds(20);  // twice the period of the checks

}  // namespace

void StallTimer::check(const std::optional<std::uint64_t>& steps, const ThreadState& state, Duration since_last,
                       bool starving) {
  const Duration used = state.processor_time - std::exchange(processor_time_, state.processor_time);
  const bool same = steps && steps == steps_;
  steps_ = steps;
  if (!same) {
    stalled_ = Duration::zero();
    return;
  }
  const bool blocked = state.activity == ThreadState::Activity::kBlocked && !starving;
  stalled_ += blocked ? std::max(used, std::min(since_last, kLongestStep)) : used;
}

bool StallTimer::starves(const std::optional<std::uint64_t>& steps, const ThreadState& state) const {
  return steps && state.activity == ThreadState::Activity::kRunnable && state.processor_time == processor_time_;
}

}  // namespace sweep_guard_ros
