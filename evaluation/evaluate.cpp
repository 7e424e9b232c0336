#include "evaluation/evaluate.h"

#include <algorithm>

#include "evaluation/parallel.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::StampedPose;
using sweep_guard_recording::Recording;

namespace {

sweep_guard_core::PredictorOptions withPredictor(sweep_guard_core::PredictorOptions options,
                                                 const std::string& predictor) {
  if (predictor != kCommandPredictor) options.predictor = predictor;
  return options;
}

/// Returns the commands of a recording if the predictor is told them.
const std::vector<StampedPose>* commandsFor(const std::string& predictor, const Recording& recording) {
  return predictor == kCommandPredictor ? &recording.commands : nullptr;
}

WarningReport emptyReport(const std::string& recording, size_t placements, const Options& options) {
  const double chosen = options.min_probability;
  WarningReport report{recording, placements, options.predictors, {chosen}, 0, {}};
  if (options.wantsTradeoff()) report.min_probabilities = tradeoffThresholds(chosen);
  const auto& all = report.min_probabilities;
  report.chosen = static_cast<size_t>(std::find(all.begin(), all.end(), chosen) - all.begin());
  report.statistics.resize(options.predictors.size());
  return report;
}

}  // namespace

std::vector<ErrorReport> reportErrors(const std::vector<Recording>& recordings, const Options& options,
                                      const Progress& progress) {
  const sweep_guard_core::Duration future = std::max(kFuture, options.horizons.back());
  const size_t predictors = options.predictors.size();
  std::vector<SampledMotion> motions;
  for (const Recording& recording : recordings) {
    const RecordedMotion motion(recording.poses);
    motions.push_back({recording.poses, motion, samplesOf(recording.poses, motion, kHistory, future)});
  }
  std::vector<std::vector<std::vector<ErrorsAhead>>> errors(recordings.size(),
                                                            std::vector<std::vector<ErrorsAhead>>(predictors));
  inParallel(recordings.size() * predictors, [&](size_t i) {
    const auto predictor = withPredictor(options.predictor, options.predictors[i % predictors]);
    SampledMotion motion = motions[i / predictors];
    motion.commands = commandsFor(options.predictors[i % predictors], recordings[i / predictors]);
    errors[i / predictors][i % predictors] = predictionErrors(motion, options.horizons, predictor, progress);
  });
  std::vector<ErrorReport> reports;
  reports.reserve(recordings.size());
  for (size_t i = 0; i < recordings.size(); ++i)
    reports.push_back({recordings[i].name, options.predictors, options.horizons, summaries(errors[i])});
  return reports;
}

std::vector<WarningReport> reportWarnings(const std::vector<Recording>& recordings, const Options& options,
                                          const Progress& progress) {
  std::vector<std::vector<ObstaclePlacement>> placements;
  std::vector<WarningReport> reports;
  for (const Recording& recording : recordings) {
    placements.push_back(
        placeObstacles(RecordedMotion(recording.poses), options.simulation.tool, options.placements, options.seed));
    reports.push_back(emptyReport(recording.name, placements.back().size(), options));
  }
  inParallel(recordings.size() * options.predictors.size(), [&](size_t i) {
    const size_t recording = i / options.predictors.size();
    const size_t predictor = i % options.predictors.size();
    WarningReport& report = reports[recording];
    GuardSimulationOptions simulation = options.simulation;
    simulation.guard.predictor = withPredictor(options.predictor, options.predictors[predictor]);
    simulation.min_probabilities = report.min_probabilities;
    simulation.commands = commandsFor(options.predictors[predictor], recordings[recording]);
    const auto& placed = placements[recording];
    for (const auto& levels : simulateGuard(recordings[recording].poses, placed, simulation, progress)) {
      report.statistics[predictor].push_back(
          {alarmStatistics(placed, levels, alarmRules()[0]), alarmStatistics(placed, levels, alarmRules()[1])});
    }
  });
  return reports;
}

}  // namespace sweep_guard_evaluation
