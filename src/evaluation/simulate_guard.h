#pragma once

#include <vector>

#include "evaluation/alarm_statistics.h"
#include "evaluation/prediction_errors.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_evaluation {

struct GuardSimulationOptions {
  sweep_guard_core::ConvexShape tool = sweep_guard_core::ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1);
  sweep_guard_core::GuardOptions guard;  ///< its clock is not asked: the budget of time never runs out
  /// Workpieces never go stale. `min_probability` is taken from below.
  sweep_guard_core::WarningLimits limits = {std::chrono::milliseconds(100), sweep_guard_core::Duration::max(),
                                            std::chrono::milliseconds(500)};
  std::vector<double> min_probabilities;  ///< thresholds to try, each in (0, 1]
};

/// Runs a guard along a recorded motion, with every placement a workpiece of its own while its episode lasts.
///
/// As in the node: each pose is swept to and looked ahead from; a monitor for each placement makes the warning of what
/// was found of this one alone, at every pose and every 10 ms between poses. Poses come without delay. The detector is
/// `reference`, which finds what `select` finds.
///
/// @param poses       stamps do not decrease; those that share one are all given to the guard
/// @param placements  ordered by begin
/// @returns by threshold, then by placement
std::vector<std::vector<Episode>> simulateGuard(const std::vector<sweep_guard_core::StampedPose>& poses,
                                                const std::vector<ObstaclePlacement>& placements,
                                                const GuardSimulationOptions& options, const Progress& progress);

}  // namespace sweep_guard_evaluation
