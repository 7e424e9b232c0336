#include "monitor/warning_merger.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

#include "common/number_text.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_core {
namespace {

constexpr Duration kMaxLag = std::chrono::milliseconds(50);  // that needs no word

int rank(WarningLevel level) {
  if (level == WarningLevel::kClear) return 0;
  return level == WarningLevel::kUnknown ? 1 : static_cast<int>(level);
}

template <typename Value>
std::optional<Value> smaller(const std::optional<Value>& a, const std::optional<Value>& b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

}  // namespace

WarningMerger::WarningMerger(std::vector<std::string> guards, Duration timeout)
    : guards_(std::move(guards)), timeout_(timeout), newest_(guards_.size()) {
  assert(!guards_.empty());
}

void WarningMerger::hear(size_t guard, HeardWarning warning) { newest_[guard] = std::move(warning); }

std::string WarningMerger::silence(size_t guard, const Instant& now) const {
  const auto& newest = newest_[guard];
  if (!newest) return "no warning yet";
  const Duration since = now.steady - newest->received.steady;
  const Duration left = newest->valid_until - now.stamp;
  if (since > timeout_ || left < Duration::zero()) {
    const Duration lag = newest->received.stamp - (newest->valid_until - kWarningValid);
    return lag > kMaxLag ? "newest warning came " + inSeconds(lag) + " late, or clocks differ"
                         : "silent for " + inSeconds(since);
  }
  if (left > kWarningValid + kMaxLead) return "warning is " + inSeconds(left - kWarningValid) + " ahead: clocks differ";
  return {};
}

MergedWarning WarningMerger::merged(const Instant& now) const {
  MergedWarning all;
  all.level = WarningLevel::kClear;
  all.covered_until = Time::max();
  all.valid_until = now.stamp + kWarningValid;
  std::string text;
  bool any_silent = false;
  for (size_t guard = 0; guard < guards_.size(); ++guard) {
    const std::string silent = silence(guard, now);
    if (silent.empty()) addTo(all, guard);
    any_silent = any_silent || !silent.empty();
    const bool clear = silent.empty() && newest_[guard]->level == WarningLevel::kClear;
    if (!clear)
      text += (text.empty() ? ": " : "; ") + guards_[guard] + ": " + (silent.empty() ? newest_[guard]->text : silent);
  }
  if (any_silent) {
    all.reasons |= kNotCovered;
    all.covered_until = Time();
    if (all.level == WarningLevel::kClear) {
      all.level = WarningLevel::kUnknown;
      all.leader.reset();
    }
  }
  all.acknowledged = all.leader && newest_[*all.leader]->acknowledged;
  all.text = styleOf(all.level).name + text;
  return all;
}

void WarningMerger::addTo(MergedWarning& all, size_t guard) const {
  const HeardWarning& warning = *newest_[guard];
  all.reasons |= warning.reasons;
  all.time_to_collision = smaller(all.time_to_collision, warning.time_to_collision);
  all.covered_until = std::min(all.covered_until, warning.covered_until);
  all.valid_until = std::min(all.valid_until, warning.valid_until);
  all.intended = all.intended || warning.intended;
  all.seen = smaller(all.seen, warning.seen);
  if (all.leader && !leads(guard, *all.leader)) return;
  all.leader = guard;
  all.level = warning.level;
}

bool WarningMerger::leads(size_t guard, size_t other) const {
  const auto order = [](const HeardWarning& warning) {
    return std::tuple(-rank(warning.level), warning.held, warning.acknowledged,
                      warning.time_to_collision.value_or(Duration::max()), warning.stamp);
  };
  return order(*newest_[guard]) < order(*newest_[other]);
}

}  // namespace sweep_guard_core
