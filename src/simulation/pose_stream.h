#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "simulation/drilling.h"
#include "simulation/guided_tip.h"
#include "simulation/replay.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_simulation {

/// The next pose of the tip, its stamp counted from the start of the motion (0); empty at the end.
using PoseStream = std::function<std::optional<sweep_guard_core::StampedPose>()>;

/// @param rate  [Hz] > 0
/// @param loop  go round for ever; false: once
PoseStream sampled(const Drilling& drilling, double rate, bool loop);

PoseStream replayed(std::vector<sweep_guard_core::StampedPose> poses, const Replay::Options& options);

/// Moves a tip on by `dt` [s], as its input has it at that moment.
using Guide = std::function<void(GuidedTip& tip, double dt)>;

/// Without end, and at an even rate, as a device's: it goes on while the tip rests.
/// @param rate  [Hz] > 0
PoseStream guided(const GuidedTip& tip, double rate, Guide guide);

}  // namespace sweep_guard_simulation
