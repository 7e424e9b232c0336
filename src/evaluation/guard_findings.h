#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/simulate_guard.h"
#include "recording/level_trace.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_evaluation {

/// Keeps what a guard found about one object, so that warnings can be computed for any limits without sweeping again.
struct ObjectFindings {
  /// A predicted sweep that meets the object, or does so with a larger probability than every sweep before it.
  struct Sweep {
    sweep_guard_core::Duration from;  ///< after the stamp of the pose
    double probability;
    bool contact;
  };
  struct AtPose {
    size_t pose;
    bool contact;  ///< of the sweep to this pose
    size_t sweeps_end;
  };

  std::vector<AtPose> poses;  ///< where something was found: a contact, or a sweep with a probability above 0
  std::vector<Sweep> sweeps;  ///< those of all poses, one pose after the other: up to the first contact of each pose
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
