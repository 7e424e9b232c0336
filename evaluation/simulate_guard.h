#pragma once

#include <vector>

#include "evaluation/obstacle_placement.h"
#include "evaluation/progress.h"
#include "recording/level_trace.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_evaluation {

struct GuardSimulationOptions {
  sweep_guard_core::ConvexShape tool = sweep_guard_core::ConvexShape::cylinder(/*radius=*/0.005, /*length=*/0.1);
  sweep_guard_core::GuardOptions guard;  ///< its clock is not used: the time budget never runs out
  /// Workpieces never become stale. `thresholds` are not used; see min_probabilities.
  sweep_guard_core::WarningLimits limits = {std::chrono::milliseconds(100), sweep_guard_core::Duration::max(),
                                            std::chrono::milliseconds(500)};
  /// What goes to the robot; null: the guard is not told. Stamps do not decrease.
  const std::vector<sweep_guard_core::StampedPose>* commands = nullptr;
  std::vector<double> min_probabilities;  ///< thresholds to simulate, each in (0, 1]
};

/// Runs a guard along a recorded motion. Every placement is a workpiece of its own during its episode.
///
/// Works like the node: the guard sweeps to each pose and predicts from it. A monitor for each placement computes the
/// warning for this placement alone, at every pose and every 10 ms between poses. Poses arrive without delay. The
/// detector is `reference`, which finds the same triangles as `select`.
///
/// @param poses       stamps do not decrease; poses with equal stamps all reach the guard
/// @param placements  ordered by begin
/// @return levels of the warning up to the first pose at or after the end of the placement: by threshold, then by placement
std::vector<std::vector<sweep_guard_recording::LevelTrace>> simulateGuard(
    const std::vector<sweep_guard_core::StampedPose>& poses, const std::vector<ObstaclePlacement>& placements,
    const GuardSimulationOptions& options, const Progress& progress);

}  // namespace sweep_guard_evaluation
