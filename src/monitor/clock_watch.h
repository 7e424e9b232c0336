#pragma once

#include <ctime>
#include <optional>
#include <string>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Notices that stamps from before do not count any more: the clock of the stamps went back, or the machine was
/// suspended. Suspended time is no time for the steady clock, so the ages of the inputs do not show it.
class ClockWatch {
 public:
  /// @param stamp      the clock of the stamps
  /// @param suspended  time that the machine was suspended since it started
  /// @returns what happened since the call before; empty: nothing
  std::optional<std::string> jump(Time stamp, Duration suspended);

 private:
  Time stamp_;
  std::optional<Duration> suspended_;
};

using ReadClock = Duration (*)(clockid_t clock);
Duration readClock(clockid_t clock);

/// Returns the time that the machine was suspended since it started.
Duration suspendedTime(ReadClock read = readClock);

}  // namespace sweep_guard_core
