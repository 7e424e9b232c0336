#include "session/held_warnings.h"

#include <algorithm>
#include <array>

namespace sweep_guard_session {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

constexpr std::size_t kLevelCount = 5;
const GuardWarning kUntold{{}, {}, WarningLevel::kUnknown, "UNKNOWN: the guard held a higher level until the end",
                           {}, {}};

/// An interval in which a warning counts, where no higher level does.
struct Claim {
  Time begin;
  Time end;
  const GuardWarning* warning;
};

class WarningHolder {
 public:
  WarningHolder(const std::vector<GuardWarning>& warnings, const std::vector<Time>& touches, Duration hold_time,
                Time end)
      : warnings_(warnings), touches_(touches), hold_time_(hold_time), end_(end) {}

  std::vector<Claim> claims() {
    for (std::size_t i = warnings_.size(); i > 0; --i) claimPrediction(i - 1);
    std::reverse(claims_.begin(), claims_.end());
    for (std::size_t i = 0; i < warnings_.size();) i = claimContact(i);
    std::stable_sort(claims_.begin(), claims_.end(), [](const Claim& a, const Claim& b) { return a.begin < b.begin; });
    return std::move(claims_);
  }

 private:
  static bool isContact(const GuardWarning& warning) { return warning.level == WarningLevel::kContact; }
  static bool isTouching(const GuardWarning& warning) { return isContact(warning) && !warning.over_for; }

  void claim(Time begin, Time end, const GuardWarning& warning) {
    begin = std::max(begin, warnings_.front().computed);
    if (begin < end) claims_.push_back({begin, end, &warning});
  }

  // From the last warning to the first: what the guard tells next is beneath the level that it holds, or beneath a contact.
  void claimPrediction(std::size_t i) {
    const GuardWarning& warning = warnings_[i];
    const Time until = i + 1 < warnings_.size() ? warnings_[i + 1].computed : end_;
    if (isContact(warning) || warning.over_for) {
      claim(warning.computed, until, *next_);
    } else {
      next_ = &warning;
      claim(warning.computed, warning.level < WarningLevel::kConsidered ? until : until + hold_time_, warning);
    }
    if (!isContact(warning) && warning.over_for) {
      claim(warning.computed, warning.computed - *warning.over_for + hold_time_, warning);
    }
  }

  // The touch that begins with a warning, and what the guard holds of it. Returns the index behind it.
  std::size_t claimContact(std::size_t first) {
    if (!isContact(warnings_[first])) return first + 1;
    std::size_t released = first;
    while (released < warnings_.size() && isTouching(warnings_[released])) ++released;
    const Time end = endOfContact(first, released);
    std::size_t i = first;
    for (; i < released; ++i) claim(poseOf(warnings_[i]), end, warnings_[i]);
    for (; i < warnings_.size() && isContact(warnings_[i]) && !isTouching(warnings_[i]); ++i) {
      claim(poseOf(warnings_[i]), end, warnings_[i]);
    }
    return i;
  }

  // Without a pose that leaves, it lasts. What only was held has touched at its pose.
  Time endOfContact(std::size_t first, std::size_t released) const {
    if (released == warnings_.size()) return end_;
    Time last = poseOf(warnings_[released > first ? released - 1 : first]);
    const Time left = released > first ? poseOf(warnings_[released]) : last;
    const auto later = std::lower_bound(touches_.begin(), touches_.end(), left);
    if (later != touches_.begin()) last = std::max(last, *std::prev(later));
    return std::max(left, last + hold_time_);
  }

  static Time poseOf(const GuardWarning& warning) {
    return warning.pose == Time() ? warning.computed : std::min(warning.pose, warning.computed);
  }

  const std::vector<GuardWarning>& warnings_;
  const std::vector<Time>& touches_;
  Duration hold_time_;
  Time end_;
  std::vector<Claim> claims_;
  const GuardWarning* next_ = &kUntold;
};

/// What counts of each level.
class ActiveClaims {
 public:
  void add(const Claim& claim) {
    Claim& newest = newest_.at(static_cast<std::size_t>(claim.warning->level));
    newest = {claim.begin, std::max(newest.end, claim.end), claim.warning};
  }
  const GuardWarning* highest(Time time) const {
    for (std::size_t level = kLevelCount; level > 0; --level) {
      if (newest_[level - 1].end > time) return newest_[level - 1].warning;
    }
    return nullptr;
  }

 private:
  std::array<Claim, kLevelCount> newest_{};
};

std::vector<Time> boundsOf(const std::vector<Claim>& claims, Time end) {
  std::vector<Time> bounds;
  for (const Claim& claim : claims) bounds.insert(bounds.end(), {claim.begin, claim.end});
  std::sort(bounds.begin(), bounds.end());
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  bounds.erase(std::lower_bound(bounds.begin(), bounds.end(), end), bounds.end());
  return bounds;
}

}  // namespace

std::vector<LoggedWarning> holdWarnings(const std::vector<GuardWarning>& warnings, const std::vector<Time>& touches,
                                        Duration hold_time, Time end) {
  const std::vector<Claim> claims = WarningHolder(warnings, touches, hold_time, end).claims();
  std::vector<LoggedWarning> held;
  ActiveClaims active;
  const GuardWarning* before = nullptr;
  auto claim = claims.begin();
  for (const Time bound : boundsOf(claims, end)) {
    for (; claim != claims.end() && claim->begin <= bound; ++claim) active.add(*claim);
    const GuardWarning* const now = active.highest(bound);
    if (now == nullptr || now == before) continue;
    held.push_back({bound, now->level, now->text, now->time_to_collision});
    before = now;
  }
  return held;
}

}  // namespace sweep_guard_session
