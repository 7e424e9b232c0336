#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "simulation/drilling.h"
#include "simulation/guided_tip.h"
#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_simulation {

/// Returns the next pose of the tip, with its stamp counted from the start of the motion (0); empty at the end.
using PoseStream = std::function<std::optional<sweep_guard_core::StampedPose>()>;

/// Samples a scripted motion.
/// @param rate  [Hz] > 0
/// @param loop  true: repeats forever; false: plays once
PoseStream sampled(const Drilling& drilling, double rate, bool loop);

/// Plays a recorded motion pose by pose at the recorded intervals, moved to the workpiece. Keeps poses with equal
/// stamps.
/// @param motion    stamps not decreasing
/// @param loop      at the end plays backwards, then forwards again, without a jump; false: plays once
/// @param target_W  [m] lowest tip position within the first 5 s
/// @throws sweep_guard_core::InvalidInput if the motion has no poses, or has no duration and shall loop
PoseStream replayed(std::vector<sweep_guard_core::StampedPose> motion, bool loop, const Eigen::Vector3d& target_W);

/// Moves a tip for `dt` [s] by its current input.
using Guide = std::function<void(GuidedTip& tip, double dt)>;

/// Streams the poses of a guided tip without end, at a constant rate even while the tip rests.
/// @param rate  [Hz] > 0
PoseStream guided(const GuidedTip& tip, double rate, Guide guide);

}  // namespace sweep_guard_simulation
