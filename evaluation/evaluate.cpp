#include "evaluation/evaluate.h"

#include <algorithm>

#include "evaluation/parallel.h"

namespace sweep_guard_evaluation {

using sweep_guard_recording::Recording;

namespace {

/// A recording, its samples and the errors of all predictors.
struct RecordingErrors {
  RecordingErrors(const Recording& source, sweep_guard_core::Duration future)
      : recording(source), motion(source.poses), samples(samplesOf(source.poses, motion, kHistory, future)) {}

  const Recording& recording;
  RecordedMotion motion;
  std::vector<size_t> samples;
  std::vector<std::vector<ErrorsAhead>> errors;  // by predictor, then by horizon
};

sweep_guard_core::PredictorOptions withPredictor(sweep_guard_core::PredictorOptions options,
                                                 const std::string& predictor) {
  options.predictor = predictor;
  return options;
}

std::array<AlarmStatistics, 2> statisticsOf(const std::vector<Episode>& episodes) {
  return {alarmStatistics(episodes, alarmRules()[0]), alarmStatistics(episodes, alarmRules()[1])};
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
  std::vector<RecordingErrors> cases;
  for (const Recording& recording : recordings) {
    cases.emplace_back(recording, std::max(kFuture, options.horizons.back()));
    cases.back().errors.resize(options.predictors.size());
  }
  inParallel(cases.size() * options.predictors.size(), [&](size_t i) {
    RecordingErrors& current = cases[i / options.predictors.size()];
    const size_t predictor = i % options.predictors.size();
    current.errors[predictor] =
        predictionErrors({current.recording.poses, current.motion, current.samples, options.horizons,
                          withPredictor(options.predictor, options.predictors[predictor])},
                         progress);
  });
  std::vector<ErrorReport> reports;
  reports.reserve(cases.size());
  for (const RecordingErrors& current : cases)
    reports.push_back({current.recording.name, options.predictors, options.horizons, summaries(current.errors)});
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
    for (const auto& episodes :
         simulateGuard(recordings[recording].poses, placements[recording], simulation, progress)) {
      report.statistics[predictor].push_back(statisticsOf(episodes));
    }
  });
  return reports;
}

}  // namespace sweep_guard_evaluation
