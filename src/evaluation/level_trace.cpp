#include "evaluation/level_trace.h"

#include <cassert>

namespace sweep_guard_evaluation {

using sweep_guard_core::WarningLevel;

void LevelTrace::show(sweep_guard_core::Time time, WarningLevel level) {
  assert(changes_.empty() || time >= newest_);
  newest_ = time;
  if (changes_.empty() || changes_.back().level != level) changes_.push_back({time, level});
}

std::vector<Alarm> LevelTrace::alarms(WarningLevel least) const {
  assert(least >= WarningLevel::kConsidered);
  std::vector<Alarm> alarms;
  bool on = false;
  for (const Change& change : changes_) {
    if (on) alarms.back().end = change.time;
    if (!on && change.level >= least) alarms.push_back({change.time, newest_});
    on = change.level >= least;
  }
  if (on) alarms.back().end = newest_;
  return alarms;
}

}  // namespace sweep_guard_evaluation
