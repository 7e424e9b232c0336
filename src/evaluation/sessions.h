#pragma once

#include <vector>

#include "evaluation/guard_findings.h"
#include "evaluation/session_objects.h"
#include "evaluation/session_summary.h"
#include "evaluation/session_tuning.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// What a guard found in the sessions of one recording, and what happened. Alarms can be counted for any limits.
class Sessions {
 public:
  /// Places the objects, runs the guard and finds all touches.
  /// @param simulation  must outlive this object
  Sessions(const sweep_guard_recording::Recording& recording, const SessionOptions& options,
           const GuardSimulationOptions& simulation, const Progress& progress);

  /// Counts with these limits. One thread at a time.
  RecordingSessions count(const sweep_guard_core::WarningLimits& limits, NearMisses near_misses = NearMisses::kCount);

 private:
  struct Object {
    ObstacleMesh mesh;
    std::vector<Touch> touches;
  };

  std::string name_;
  RecordedMotion motion_;
  const sweep_guard_core::ConvexShape& tool_;
  size_t sessions_;
  std::vector<sweep_guard_core::TriangleMesh> meshes_W_;  // of all sessions, one after the other
  std::vector<Object> objects_;
  GuardFindings findings_;
};

/// Runs the sessions of every recording, in parallel.
std::vector<Sessions> runSessions(const std::vector<sweep_guard_recording::Recording>& recordings,
                                  const SessionOptions& options, const GuardSimulationOptions& simulation,
                                  const Progress& progress);

/// Counts the sessions of every recording, in parallel.
std::vector<RecordingSessions> countSessions(std::vector<Sessions>& sessions,
                                             const sweep_guard_core::WarningLimits& limits);

/// Returns what tuningThresholds() give in all sessions. Near misses are not counted.
std::vector<TuningPoint> tuningCurve(std::vector<Sessions>& sessions, const sweep_guard_core::WarningLimits& limits);

}  // namespace sweep_guard_evaluation
