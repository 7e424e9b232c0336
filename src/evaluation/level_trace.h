#pragma once

#include <vector>

#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_evaluation {

/// A segment of time in which a warning was on without a break.
struct Alarm {
  sweep_guard_core::Time begin;
  sweep_guard_core::Time end;
};

/// The levels that a guard showed one after the other.
class LevelTrace {
 public:
  /// That level is shown from now on.
  /// @param time  not before that of the call before
  void show(sweep_guard_core::Time time, sweep_guard_core::WarningLevel level);

  /// Stretches in which the level was that or a higher one; kUnknown and kClear are no warnings. The last ends when
  /// the newest level was shown, if it is one of these.
  /// @param least  kConsidered, kReflex or kContact
  std::vector<Alarm> alarms(sweep_guard_core::WarningLevel least) const;

 private:
  struct Change {
    sweep_guard_core::Time time;
    sweep_guard_core::WarningLevel level;
  };
  std::vector<Change> changes_;
  sweep_guard_core::Time newest_;
};

}  // namespace sweep_guard_evaluation
