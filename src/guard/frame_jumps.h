#pragma once

#include <cstdint>
#include <optional>

#include "guard/pose_history.h"
#include "sweep_guard/prediction/jump.h"

namespace sweep_guard_core {

/// Returns the fastest jump of a body of the tool, seen from a frame, after the pose of this number; empty: there was none.
std::optional<JumpSpeed> jumpAfter(std::uint64_t number, const PoseHistory& history, const SpeedLimits& limits);

}  // namespace sweep_guard_core
