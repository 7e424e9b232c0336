#pragma once

#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// So far the clocks of two machines may differ.
constexpr auto kFutureTolerance = std::chrono::milliseconds(50);

/// Whether a stamp lies in the future. Simulated time comes by a connection of its own, which a message may overtake: a
/// stamp that is ahead of it by less than half a second is waited for, and no longer than that on the wall.
bool liesInFuture(sweep_guard_core::Time stamp);

}  // namespace sweep_guard_ros
