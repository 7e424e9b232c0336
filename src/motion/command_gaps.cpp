#include "sweep_guard/motion/command_gaps.h"

#include <algorithm>
#include <cassert>
#include <cstdio>
#include <numeric>
#include <utility>

namespace sweep_guard_core {
namespace {

constexpr int kRareIntervals = 2;  // one may be a command that was lost

std::string secondsText(Duration duration) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g s", toSeconds(duration));
  return text.data();
}

}  // namespace

CommandGaps::CommandGaps(Duration timeout, std::string parameter)
    : timeout_(timeout), parameter_(std::move(parameter)) {}

void CommandGaps::received(const Timestamps& command) {
  if (newest_) {
    const Duration interval = command.received - newest_->received;
    if (interval > kPause) {
      count_ = 0;
    } else {
      intervals_[count_++ % kIntervals] = interval;
    }
  }
  newest_ = command;
}

std::string CommandGaps::rarity(SteadyTime now) const {
  const auto end = intervals_.begin() + std::min(count_, kIntervals);
  const auto exceeds = [this](Duration interval) { return interval > timeout_; };
  if (!newest_ || now - newest_->received > kPause || std::count_if(intervals_.begin(), end, exceeds) < kRareIntervals)
    return "";
  const Duration mean = std::accumulate(intervals_.begin(), end, Duration::zero()) / (end - intervals_.begin());
  return "commands come every " + secondsText(mean) + ", up to " +
         secondsText(*std::max_element(intervals_.begin(), end)) + " apart, but " + parameter_ + " is " +
         secondsText(timeout_) + ": send them more often, or raise it";
}

std::string CommandGaps::tooOld(const Instant& now) const {
  assert(newest_);
  const Duration waited = now.steady - newest_->received;
  const Duration age = std::max(waited, now.stamp - newest_->stamp);
  const bool came_late = 2 * (age - waited) > timeout_;
  std::string rare = came_late ? "" : rarity(now.steady);
  if (!rare.empty()) return rare;
  return (came_late ? "the stamp of the newest command is " : "no command: the newest is ") + secondsText(age) +
         " old, and " + parameter_ + " is " + secondsText(timeout_) +
         (came_late ? ": clocks differ, or commands wait on their way" : "");
}

}  // namespace sweep_guard_core
