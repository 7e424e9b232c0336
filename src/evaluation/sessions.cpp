#include "evaluation/sessions.h"

#include <optional>

#include "evaluation/parallel.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::TriangleMesh;
using sweep_guard_core::WarningLimits;
using sweep_guard_recording::Recording;

namespace {

double minutesOf(const RecordedMotion& motion) {
  double seconds = 0.0;
  for (const RecordedMotion::Segment& segment : motion.segments()) {
    seconds += sweep_guard_core::toSeconds(segment.end - segment.begin);
  }
  return seconds / 60.0;
}

}  // namespace

Sessions::Sessions(const Recording& recording, const SessionOptions& options, const GuardSimulationOptions& simulation,
                   const Progress& progress)
    : name_(recording.name), motion_(recording.poses), tool_(simulation.tool), sessions_(options.sessions) {
  for (size_t session = 0; session < sessions_; ++session) {
    for (TriangleMesh& mesh_W : placeInWorkspace(motion_, options, session)) meshes_W_.push_back(std::move(mesh_W));
  }
  findings_ = findContacts(recording.poses, meshes_W_, simulation, progress);
  for (const TriangleMesh& mesh_W : meshes_W_) {
    objects_.push_back({ObstacleMesh(tool_, mesh_W), {}});
    objects_.back().touches = touchesOf(motion_, tool_, objects_.back().mesh);
  }
}

RecordingSessions Sessions::count(const WarningLimits& limits, NearMisses near_misses) {
  RecordingSessions counted{name_, minutesOf(motion_), std::vector<std::vector<SessionCount>>(sessions_)};
  for (size_t i = 0; i < objects_.size(); ++i) {
    const auto levels = levelsOf(findings_, i, limits);
    counted.objects[i * sessions_ / objects_.size()].push_back(
        countSession({motion_, tool_, objects_[i].mesh, objects_[i].touches, levels, near_misses}));
  }
  return counted;
}

std::vector<Sessions> runSessions(const std::vector<Recording>& recordings, const SessionOptions& options,
                                  const GuardSimulationOptions& simulation, const Progress& progress) {
  std::vector<std::optional<Sessions>> run(recordings.size());
  inParallel(recordings.size(), [&](size_t i) { run[i].emplace(recordings[i], options, simulation, progress); });
  std::vector<Sessions> sessions;
  sessions.reserve(run.size());
  for (std::optional<Sessions>& one : run) sessions.push_back(std::move(*one));
  return sessions;
}

std::vector<RecordingSessions> countSessions(std::vector<Sessions>& sessions, const WarningLimits& limits) {
  std::vector<RecordingSessions> counted(sessions.size());
  inParallel(sessions.size(), [&](size_t i) { counted[i] = sessions[i].count(limits); });
  return counted;
}

std::vector<TuningPoint> tuningCurve(std::vector<Sessions>& sessions, const WarningLimits& limits) {
  std::vector<TuningPoint> points;
  for (const auto& thresholds : tuningThresholds(limits.thresholds)) {
    WarningLimits changed = limits;
    changed.thresholds = thresholds;
    std::vector<RecordingSessions> counted(sessions.size());
    inParallel(sessions.size(), [&](size_t i) { counted[i] = sessions[i].count(changed, NearMisses::kSkip); });
    points.push_back({thresholds, figuresOf(counted)});
  }
  return points;
}

}  // namespace sweep_guard_evaluation
