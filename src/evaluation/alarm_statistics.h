#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/level_trace.h"
#include "evaluation/obstacle_placement.h"

namespace sweep_guard_evaluation {

/// A kind of warning, and when it is in the right.
struct AlarmRule {
  std::string interval;                  ///< its name in tables
  sweep_guard_core::WarningLevel least;  ///< on while this level or a higher one is shown
  sweep_guard_core::Duration window;     ///< a contact must follow within it, or the alarm is false; > 0
  /// A warning that comes no earlier than the contact itself counts as given.
  bool at_contact;
};

/// `reflex` (REFLEX or CONTACT; 0.5 s) and `considered` (CONSIDERED, REFLEX or CONTACT; 2 s), in this order.
const std::array<AlarmRule, 2>& alarmRules();

/// What the guard showed while a obstacle was there.
struct Episode {
  ObstaclePlacement placement;
  LevelTrace shown;  ///< up to the first pose at or after the end
};

/// How long before the contact the alarm came on that was on at the contact, and had been since. Negative: only the
/// first pose after the contact brought it; such a one counts where the rule allows. Empty: not warned.
/// @param episode  with a contact
std::optional<sweep_guard_core::Duration> leadOf(const Episode& episode, const AlarmRule& rule);

/// How many alarms of an episode were false. An alarm is unjustified as long as no contact follows within the window.
/// Each unjustified segment counts once, and once more for every further window that it lasts: an alarm that never ends
/// is no way out.
size_t falseAlarmsOf(const Episode& episode, const AlarmRule& rule);

/// What a kind of warning was worth over many episodes.
struct AlarmStatistics {
  size_t contacts = 0;
  std::vector<double> leads;  ///< of the contacts warned of [s], ascending
  size_t false_alarms = 0;
  double minutes = 0.0;  ///< of all episodes together

  double falseAlarmsPerMinute() const;    ///< NaN of no time
  double warnedAhead(double lead) const;  ///< share of the contacts warned of so long before [s]; NaN without contacts
};

AlarmStatistics alarmStatistics(const std::vector<Episode>& episodes, const AlarmRule& rule);

}  // namespace sweep_guard_evaluation
