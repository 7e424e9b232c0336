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

/// Returns the time from the begin of the alarm that is on at the contact to the contact. Negative: the alarm began at
/// the first pose after the contact, and the rule allows that. Empty: no warning.
/// @param levels  of the warning while the obstacle was there
std::optional<sweep_guard_core::Duration> leadOf(sweep_guard_core::Time contact,
                                                 const sweep_guard_recording::LevelTrace& levels,
                                                 const AlarmRule& rule);

/// Counts the false alarms while an obstacle was there. An alarm is unjustified as long as no contact follows within the window. Each
/// unjustified interval counts once, and once more for every further window that it lasts, so that an alarm that never
/// ends is no advantage.
size_t countFalseAlarms(const ObstaclePlacement& placement, const sweep_guard_recording::LevelTrace& levels,
                        const AlarmRule& rule);

/// Summary of one kind of warning beside many obstacles.
struct AlarmStatistics {
  size_t contacts = 0;
  std::vector<double> leads;  ///< leads of the contacts with a warning [s], ascending
  size_t false_alarms = 0;
  double minutes = 0.0;  ///< for which the obstacles were there

  double falseAlarmsPerMinute() const;  ///< NaN without obstacles
  double warnedAhead(
      double lead) const;  ///< share of contacts with a lead of at least `lead` [s]; NaN without contacts
};

/// @param levels  of the warning, by placement
AlarmStatistics alarmStatistics(const std::vector<ObstaclePlacement>& placements,
                                const std::vector<sweep_guard_recording::LevelTrace>& levels, const AlarmRule& rule);

}  // namespace sweep_guard_evaluation
