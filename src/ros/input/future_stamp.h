#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Largest accepted difference between the clocks of two machines.
constexpr auto kFutureTolerance = std::chrono::milliseconds(50);

/// Tells the sender of a refused message what to do.
constexpr const char* kFutureStampText = "stamp lies in the future: are the clocks synchronized?";

/// Returns whether the stamp of an input lies in the future. Simulated time has its own connection, which a message may
/// overtake: a stamp less than half a second ahead of it is waited for, for at most half a second of wall time, and so is
/// its first message. What was waited for is received when the wait ends: it is no backlog.
bool liesInFuture(sweep_guard_core::Timestamps& input);

}  // namespace sweep_guard_ros
