#include "evaluation/sessions.h"

#include <utility>

#include "evaluation/parallel.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::TriangleMesh;
using sweep_guard_core::WarningLimits;
using sweep_guard_recording::Recording;

namespace {

double minutesOf(const RecordedMotion& motion) {
  double seconds = 0.0;
  for (const auto& segment : motion.segments()) {
    seconds += sweep_guard_core::toSeconds(segment.end - segment.begin);
  }
  return seconds / 60.0;
}

/// Runs task(sessions, part) for every part of every recording, in parallel.
template <typename Task>
void forEachPart(std::vector<Sessions>& sessions, const Task& task) {
  std::vector<std::pair<Sessions*, size_t>> parts;
  for (Sessions& one : sessions) {
    for (size_t part = 0; part < one.parts(); ++part) parts.emplace_back(&one, part);
  }
  inParallel(parts.size(), [&](size_t i) { task(*parts[i].first, parts[i].second); });
}

}  // namespace

Sessions::Sessions(const Recording& recording, const SessionOptions& options, const GuardSimulationOptions& simulation,
                   size_t parts)
    : recording_(recording),
      simulation_(simulation),
      motion_(recording.poses),
      sessions_(options.sessions),
      parts_(parts) {
  simulation_.commands = &recording.commands;
  std::vector<TriangleMesh> meshes_W;
  for (size_t session = 0; session < sessions_; ++session) {
    for (TriangleMesh& mesh_W : placeInWorkspace(motion_, options, session)) meshes_W.push_back(std::move(mesh_W));
  }
  for (size_t i = 0; i < meshes_W.size(); ++i) {
    parts_[i * parts / meshes_W.size()].meshes_W.push_back(std::move(meshes_W[i]));
  }
}

void Sessions::run(size_t number, const Progress& progress) {
  Part& part = parts_[number];
  part.findings = findContacts(recording_.poses, part.meshes_W, simulation_, progress);
  for (const TriangleMesh& mesh_W : part.meshes_W) {
    ObjectSession& object = part.objects.emplace_back(ObjectSession{ObstacleMesh(simulation_.tool, mesh_W), {}, {}});
    object.touches = touchesOf(motion_, object.mesh);
  }
}

void Sessions::count(size_t number, const WarningLimits& limits, bool near_misses) {
  Part& part = parts_[number];
  for (size_t i = 0; i < part.objects.size(); ++i)
    countSession(motion_, levelsOf(part.findings, i, limits), near_misses, part.objects[i]);
}

std::vector<PredictionOutcome> Sessions::outcomes(sweep_guard_core::Duration interval) const {
  std::vector<PredictionOutcome> all;
  for (const Part& part : parts_) {
    for (size_t i = 0; i < part.objects.size(); ++i) {
      const auto some = outcomesOf(motion_, part.findings, i, part.objects[i].touches, interval);
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  return all;
}

RecordingSessions Sessions::counted() const {
  std::vector<SessionCount> counts;
  for (const Part& part : parts_) {
    for (const ObjectSession& object : part.objects) counts.push_back(object.count);
  }
  RecordingSessions counted{recording_.name, minutesOf(motion_), std::vector<std::vector<SessionCount>>(sessions_)};
  for (size_t i = 0; i < counts.size(); ++i) counted.objects[i * sessions_ / counts.size()].push_back(counts[i]);
  return counted;
}

std::vector<Sessions> runSessions(const std::vector<Recording>& recordings, const SessionOptions& options,
                                  const GuardSimulationOptions& simulation, const Progress& progress) {
  const size_t parts = (coreCount() + recordings.size() - 1) / recordings.size();
  std::vector<Sessions> sessions;
  sessions.reserve(recordings.size());
  for (const Recording& recording : recordings) sessions.emplace_back(recording, options, simulation, parts);
  forEachPart(sessions, [&](Sessions& one, size_t part) {
    one.run(
        part, part == 0 ? progress : [](size_t) {});
  });
  return sessions;
}

std::vector<RecordingSessions> countSessions(std::vector<Sessions>& sessions, const WarningLimits& limits,
                                             bool near_misses) {
  forEachPart(sessions, [&](Sessions& one, size_t part) { one.count(part, limits, near_misses); });
  std::vector<RecordingSessions> counted;
  counted.reserve(sessions.size());
  for (const Sessions& one : sessions) counted.push_back(one.counted());
  return counted;
}

std::vector<TuningPoint> tuningCurve(std::vector<Sessions>& sessions, const WarningLimits& limits) {
  std::vector<TuningPoint> points;
  for (const auto& thresholds : tuningThresholds(limits.thresholds)) {
    WarningLimits changed = limits;
    changed.thresholds = thresholds;
    points.push_back({thresholds, sumOf(countSessions(sessions, changed, /*near_misses=*/false))});
  }
  return points;
}

}  // namespace sweep_guard_evaluation
