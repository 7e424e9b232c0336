#include "evaluation/alarm_statistics.h"

#include <algorithm>

namespace sweep_guard_evaluation {

using std::chrono::milliseconds;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;
using sweep_guard_recording::LevelTrace;
using sweep_guard_recording::TimeInterval;

const std::array<AlarmRule, 2>& alarmRules() {
  static const std::array<AlarmRule, 2> kRules = {
      {{"reflex", WarningLevel::kReflex, milliseconds(500), /*at_contact=*/true},
       {"considered", WarningLevel::kConsidered, milliseconds(2000), /*at_contact=*/false}}};
  return kRules;
}

std::optional<Duration> leadOf(Time contact, const LevelTrace& levels, const AlarmRule& rule) {
  const std::vector<TimeInterval> alarms = levels.alarms(rule.min_level);
  const auto on = std::find_if(alarms.begin(), alarms.end(), [&](const TimeInterval& alarm) {
    return alarm.end >= contact && (alarm.begin <= contact || rule.at_contact);
  });
  if (on == alarms.end()) return std::nullopt;
  return contact - on->begin;
}

size_t countFalseAlarms(const ObstaclePlacement& placement, const LevelTrace& levels, const AlarmRule& rule) {
  const Time justified = placement.contact ? *placement.contact - rule.window : placement.end;
  size_t count = 0;
  for (const TimeInterval& alarm : levels.alarms(rule.min_level)) {
    if (alarm.begin >= justified) continue;
    const Duration unjustified = std::min(alarm.end, justified) - alarm.begin;
    count += 1 + static_cast<size_t>(unjustified / rule.window);
  }
  return count;
}

double AlarmStatistics::falseAlarmsPerMinute() const { return static_cast<double>(false_alarms) / minutes; }

double AlarmStatistics::warnedAhead(double lead) const {
  const auto enough = leads.end() - std::lower_bound(leads.begin(), leads.end(), lead);
  return static_cast<double>(enough) / static_cast<double>(contacts);
}

AlarmStatistics alarmStatistics(const std::vector<ObstaclePlacement>& placements, const std::vector<LevelTrace>& levels,
                                const AlarmRule& rule) {
  AlarmStatistics statistics;
  for (size_t i = 0; i < placements.size(); ++i) {
    const ObstaclePlacement& placement = placements[i];
    statistics.minutes += sweep_guard_core::toSeconds(placement.end - placement.begin) / 60.0;
    statistics.false_alarms += countFalseAlarms(placement, levels[i], rule);
    if (!placement.contact) continue;
    ++statistics.contacts;
    if (const auto lead = leadOf(*placement.contact, levels[i], rule))
      statistics.leads.push_back(sweep_guard_core::toSeconds(*lead));
  }
  std::sort(statistics.leads.begin(), statistics.leads.end());
  return statistics;
}

}  // namespace sweep_guard_evaluation
