#pragma once

#include <vector>

#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_recording {

struct TimeInterval {
  sweep_guard_core::Time begin;
  sweep_guard_core::Time end;
};

/// An interval of level CONTACT, and since when the guard had warned of it: the level was CONSIDERED or higher (REFLEX
/// or higher) from then on without a break. Equal to the begin of the contact if there was no warning. A warning that
/// remains from an earlier contact does not count.
struct WarnedContact {
  TimeInterval contact;
  sweep_guard_core::Time considered_since;
  sweep_guard_core::Time reflex_since;
};

/// Records the level of a warning over time.
class LevelTrace {
 public:
  /// Appends a level that lasts until the next call.
  /// @param time  not earlier than in the previous call
  void add(sweep_guard_core::Time time, sweep_guard_core::WarningLevel level) {
    newest_ = time;
    if (changes_.empty() || changes_.back().value != level) changes_.push_back({time, level});
  }

  /// Returns the intervals in which the level was `min_level` or higher without a break. The last one ends at the newest
  /// time if the level is still as high.
  /// @param min_level  kConsidered, kReflex or kContact
  std::vector<TimeInterval> alarms(sweep_guard_core::WarningLevel min_level) const {
    std::vector<TimeInterval> alarms;
    for (size_t i = 0; i < changes_.size(); ++i) {
      if (changes_[i].value < min_level) continue;
      if (i == 0 || changes_[i - 1].value < min_level) alarms.push_back({changes_[i].stamp, {}});
      alarms.back().end = endOf(i);
    }
    return alarms;
  }

  /// Returns the contacts in the order of time.
  std::vector<WarnedContact> contacts() const {
    using sweep_guard_core::WarningLevel;
    std::vector<WarnedContact> contacts;
    for (size_t i = 0; i < changes_.size(); ++i) {
      if (changes_[i].value != WarningLevel::kContact) continue;
      contacts.push_back(
          {{changes_[i].stamp, endOf(i)}, since(i, WarningLevel::kConsidered), since(i, WarningLevel::kReflex)});
    }
    return contacts;
  }

 private:
  sweep_guard_core::Time endOf(size_t i) const { return i + 1 < changes_.size() ? changes_[i + 1].stamp : newest_; }

  sweep_guard_core::Time since(size_t contact, sweep_guard_core::WarningLevel min_level) const {
    const auto warns = [&](size_t i) {
      return changes_[i].value >= min_level && changes_[i].value < sweep_guard_core::WarningLevel::kContact;
    };
    while (contact > 0 && warns(contact - 1)) --contact;
    return changes_[contact].stamp;
  }

  std::vector<sweep_guard_core::StampedValue<sweep_guard_core::WarningLevel>> changes_;
  sweep_guard_core::Time newest_;
};

}  // namespace sweep_guard_recording
