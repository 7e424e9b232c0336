#pragma once

#include <vector>

#include "evaluation/simulate_guard.h"
#include "recording/level_trace.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_evaluation {

/// Keeps what a guard found about one object, so that warnings can be computed for any limits without sweeping again.
struct ObjectFindings {
  struct AtPose {
    size_t pose;
    bool contact;  ///< of the sweep to this pose
    size_t sweeps_end;
  };

  std::vector<AtPose> poses;  ///< where something was found: a contact, or a sweep that comes near
  /// Predicted sweeps that meet the object, or come nearer to it than every sweep before; those of all poses, one pose
  /// after the other.
  std::vector<sweep_guard_core::PredictedSweep> sweeps;

  /// Returns the number of the first sweep of one of `poses`.
  size_t sweepsBegin(size_t found) const { return found == 0 ? 0 : poses[found - 1].sweeps_end; }
};

/// Keeps what a guard found along a recorded motion.
struct GuardFindings {
  std::vector<sweep_guard_core::Time> stamps;       ///< of the poses
  std::vector<sweep_guard_core::Duration> lengths;  ///< of the predicted paths; 0: no motion was known
  std::vector<ObjectFindings> objects;
};

/// Runs a guard along a recorded motion, with objects that are there all the time. Works like the node: the guard sweeps
/// to each pose and predicts from it. Passes over objects that are too far away to be met with any probability.
/// @param poses    stamps do not decrease
/// @param options  the limits and thresholds are not used
GuardFindings findContacts(const std::vector<sweep_guard_core::StampedPose>& poses,
                           const std::vector<sweep_guard_core::TriangleMesh>& objects_W,
                           const GuardSimulationOptions& options, const Progress& progress);

/// Returns the level of the warning of one object alone: a monitor receives the findings and computes the warning at
/// every pose and every 10 ms between poses, except where it cannot warn.
sweep_guard_recording::LevelTrace levelsOf(const GuardFindings& findings, size_t object,
                                           const sweep_guard_core::WarningLimits& limits);

}  // namespace sweep_guard_evaluation
