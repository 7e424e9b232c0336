#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/session_log.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/common/warning_level.h"

namespace sweep_guard_session {

/// A warning as a guard published it. Times are on the session's clock.
struct GuardWarning {
  sweep_guard_core::Time computed;  ///< not earlier than that of the previous warning
  sweep_guard_core::Time pose;      ///< stamp of the newest pose swept; epoch: none
  sweep_guard_core::WarningLevel level = sweep_guard_core::WarningLevel::kUnknown;
  std::string text{};                                             ///< level and reasons in words
  std::optional<sweep_guard_core::Duration> time_to_collision{};  ///< empty: no collision predicted, or not known
  std::optional<sweep_guard_core::Duration> over_for{};  ///< since when the level is only held; empty: it lasts
};

/// Returns the warnings of a session as a guard gives them that holds them by the session's clock and is never late: a contact
/// lasts from the stamp of the first pose to that of the last one that touched and `hold_time` longer, a prediction from when it
/// was computed until `hold_time` after its end. What is beneath a level that the guard itself holds is not known; where it holds
/// one for longer, that is the next level that it tells, or UNKNOWN if it tells none.
/// @param warnings   in the order of `computed`
/// @param touches    stamps of poses of sweeps that touched a workpiece, ascending
/// @param hold_time  >= 0
/// @param end        of the session
std::vector<LoggedWarning> holdWarnings(const std::vector<GuardWarning>& warnings,
                                        const std::vector<sweep_guard_core::Time>& touches,
                                        sweep_guard_core::Duration hold_time, sweep_guard_core::Time end);

}  // namespace sweep_guard_session
