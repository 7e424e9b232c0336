#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/monitor/warning_inputs.h"

namespace sweep_guard_core {

/// Adds the newest transform of a frame that moves, which is as old as it can be just before its next transform comes. An
/// older one restarts the measurement: time went back.
/// @param frames        ascending by name
/// @param stamp         of the transform
/// @param pose_timeout  as lateAge()
void addTransform(std::vector<WarningInputs::Frame>& frames, const std::string& name, Time stamp, const Instant& now,
                  Duration pose_timeout);

/// Forgets the other frames.
void keepOnly(const std::set<std::string>& names, std::vector<WarningInputs::Frame>& frames);

/// Returns how old a frame is that is late, or was last while it was late; empty: it is not late. It is if it is older than
/// `pose_timeout` and one period of its transforms, of which at most `pose_timeout` counts, or was so within the last second.
std::optional<Duration> lateAge(const WarningInputs::Frame& frame, const Instant& now, Duration pose_timeout);

}  // namespace sweep_guard_core
