#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/obstacle_placement.h"
#include "recording/level_trace.h"

namespace sweep_guard_evaluation {

/// A kind of warning and the rule by which it is true or false.
struct AlarmRule {
  std::string interval;                      ///< name in tables
  sweep_guard_core::WarningLevel min_level;  ///< the warning is on at this level and at higher levels
  sweep_guard_core::Duration window;         ///< an alarm is false if no contact follows within this time; > 0
  bool at_contact;                           ///< a warning that begins after the contact counts as given
};

/// Returns the rules `reflex` (REFLEX or CONTACT; 0.5 s) and `considered` (CONSIDERED, REFLEX or CONTACT; 2 s).
const std::array<AlarmRule, 2>& alarmRules();

/// The levels of the warning while an obstacle was there.
struct Episode {
  ObstaclePlacement placement;
  sweep_guard_recording::LevelTrace levels;  ///< up to the first pose at or after the end
};

/// Returns the time from the begin of the alarm that is on at the contact to the contact. Negative: the alarm began at
/// the first pose after the contact, and the rule allows that. Empty: no warning.
/// @param episode  with a contact
std::optional<sweep_guard_core::Duration> leadOf(const Episode& episode, const AlarmRule& rule);

/// Counts the false alarms of an episode. An alarm is unjustified as long as no contact follows within the window. Each
/// unjustified interval counts once, and once more for every further window that it lasts, so that an alarm that never
/// ends is no advantage.
size_t countFalseAlarms(const Episode& episode, const AlarmRule& rule);

/// Summary of one kind of warning over many episodes.
struct AlarmStatistics {
  size_t contacts = 0;
  std::vector<double> leads;  ///< leads of the contacts with a warning [s], ascending
  size_t false_alarms = 0;
  double minutes = 0.0;  ///< duration of all episodes

  double falseAlarmsPerMinute() const;  ///< NaN without episodes
  double warnedAhead(
      double lead) const;  ///< share of contacts with a lead of at least `lead` [s]; NaN without contacts
};

AlarmStatistics alarmStatistics(const std::vector<Episode>& episodes, const AlarmRule& rule);

}  // namespace sweep_guard_evaluation
