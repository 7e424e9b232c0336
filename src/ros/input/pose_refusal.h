#pragma once

#include <string>

#include "sweep_guard/common/time.h"
#include "sweep_guard/monitor/reason.h"

namespace sweep_guard_ros {

/// Why an input of the tool's motion is refused.
struct PoseRefusal {
  sweep_guard_core::Reason reason;
  std::string message;  ///< says what to do
};

/// Returns the refusal for the exception that is being handled.
PoseRefusal caughtRefusal();

/// Checks a stamp against zero and against the clock, see liesInFuture(): what throws is for caughtRefusal(). An input that waits for
/// simulated time is received when that has come.
void requireStamp(sweep_guard_core::Timestamps& input);
/// The same for a message of joints; the first one in it that is of the tool is named.
void requireStamp(sweep_guard_core::Timestamps& input, const std::string& joint);
/// Requires that a stamp is not older than the one of the pose before.
void requireOrder(sweep_guard_core::Time stamp, sweep_guard_core::Time previous);

}  // namespace sweep_guard_ros
