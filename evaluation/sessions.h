#pragma once

#include <vector>

#include "evaluation/calibration.h"
#include "evaluation/guard_findings.h"
#include "evaluation/session_objects.h"
#include "evaluation/session_summary.h"
#include "evaluation/session_tuning.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// Keeps the findings of a guard in the sessions of one recording, and the truth. Alarms can be counted for any limits.
class Sessions {
 public:
  /// Places the objects.
  /// @param recording  must outlive this object; the guard is told its commands
  /// @param parts       number of parts of about as many objects each, at least 1
  Sessions(const sweep_guard_recording::Recording& recording, const SessionOptions& options,
           const GuardSimulationOptions& simulation, size_t parts);

  size_t parts() const { return parts_.size(); }

  /// Runs the guard beside the objects of a part and finds all their touches. One thread for each part.
  void run(size_t part, const Progress& progress);

  /// Counts the alarms of a part whose guard has run. One thread for each part.
  void count(size_t part, const sweep_guard_core::WarningLimits& limits, bool near_misses);

  /// Returns what became of the predictions for an interval, of all objects.
  std::vector<PredictionOutcome> outcomes(sweep_guard_core::Duration interval) const;

  /// Returns the counts of all parts.
  RecordingSessions counted() const;

  const std::string& recording() const { return recording_.name; }

 private:
  struct Part {
    std::vector<sweep_guard_core::TriangleMesh> meshes_W;  // not moved any more: the objects refer to them
    GuardFindings findings;
    std::vector<ObjectSession> objects;
  };

  const sweep_guard_recording::Recording& recording_;
  GuardSimulationOptions simulation_;
  RecordedMotion motion_;
  size_t sessions_;
  std::vector<Part> parts_;  // of the objects of all sessions, one after the other
};

/// Runs the sessions of every recording, in parallel.
/// @param recordings  must outlive the result
std::vector<Sessions> runSessions(const std::vector<sweep_guard_recording::Recording>& recordings,
                                  const SessionOptions& options, const GuardSimulationOptions& simulation,
                                  const Progress& progress);

/// Counts the sessions of every recording, in parallel.
std::vector<RecordingSessions> countSessions(std::vector<Sessions>& sessions,
                                             const sweep_guard_core::WarningLimits& limits, bool near_misses = true);

/// Returns what tuningThresholds() give in all sessions. Near misses are not counted.
std::vector<TuningPoint> tuningCurve(std::vector<Sessions>& sessions, const sweep_guard_core::WarningLimits& limits);

}  // namespace sweep_guard_evaluation
