#include <fstream>
#include <iostream>
#include <sstream>

#include "common/run_program.h"
#include "evaluation/calibration_report.h"
#include "evaluation/driven_robot.h"
#include "evaluation/evaluate.h"
#include "evaluation/options.h"
#include "evaluation/output_file.h"
#include "evaluation/parallel.h"
#include "evaluation/progress.h"
#include "evaluation/sessions.h"
#include "evaluation/sessions_report.h"
#include "evaluation/warning_report.h"
#include "recording/recording.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/tool/mesh_file.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_recording::Recording;

std::vector<Recording> readAll(const Options& options) {
  std::vector<Recording> recordings(options.files.size());
  inParallel(options.files.size(), [&](size_t i) {
    recordings[i] = sweep_guard_recording::readRecording(options.files[i], options.topic, options.command);
    if (options.plant) recordings[i] = followed(recordings[i], *options.plant);
  });
  return recordings;
}

std::vector<sweep_guard_core::TriangleMesh> readMeshes(const std::vector<std::string>& files, double scale) {
  std::vector<sweep_guard_core::TriangleMesh> meshes;
  for (const std::string& file : files) {
    auto surface = sweep_guard_ros::readMesh(file, /*follow_link=*/true);
    for (Eigen::Vector3d& vertex : surface.vertices) vertex *= scale;
    meshes.emplace_back(surface.vertices, std::move(surface.triangles));
  }
  return meshes;
}

std::vector<RecordingSessions> readSessions(const std::string& path) {
  if (path.empty()) return {};
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  try {
    return readSessionObjects(text.str());
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

std::vector<std::string> inputsOfSessions(const Options& options) {
  std::vector<std::string> inputs = options.files;
  if (!options.compare_sessions.empty()) inputs.push_back(options.compare_sessions);
  return inputs;
}

class Evaluation {
 public:
  explicit Evaluation(const Options& options)
      : options_(options),
        recordings_(readAll(options)),
        csv_(options.csv, options.files),
        warnings_csv_(options.warnings_csv, options.files),
        tradeoff_csv_(options.tradeoff_csv, options.files),
        sessions_csv_(options.sessions_csv, options.files),
        sessions_objects_csv_(options.sessions_objects_csv, inputsOfSessions(options)),
        tune_csv_(options.tune_csv, options.files),
        calibration_csv_(options.calibration_csv, options.files),
        sessions_before_(readSessions(options.compare_sessions)) {
    for (const Recording& recording : recordings_) steps_ += recording.poses.size() * options.predictors.size();
  }

  /// Shows a progress bar during some work and returns its result.
  template <typename Work>
  auto withProgress(const std::string& title, const Work& work) {
    ProgressBar bar(title, steps_);
    return work([&](size_t poses) { bar.advance(poses); });
  }

  void evaluateErrors() {
    const std::vector<ErrorReport> reports = withProgress(
        "errors  ", [&](const Progress& progress) { return reportErrors(recordings_, options_, progress); });
    if (csv_.requested()) csv_.write(errorCsv(reports));
    for (const ErrorReport& report : reports) std::cout << errorTable(report) << '\n';
  }

  void evaluateWarnings() {
    const std::vector<WarningReport> reports = withProgress(
        "warnings", [&](const Progress& progress) { return reportWarnings(recordings_, options_, progress); });
    if (warnings_csv_.requested()) warnings_csv_.write(warningCsv(reports));
    if (tradeoff_csv_.requested()) tradeoff_csv_.write(tradeoffCsv(reports));
    for (const WarningReport& report : reports) {
      std::cout << warningTable(report) << '\n';
      if (options_.wantsTradeoff()) std::cout << tradeoffTable(report, options_.max_false_alarms) << '\n';
    }
  }

  void evaluateSessions() {
    SessionOptions placed = options_.session;
    placed.placed = readMeshes(options_.meshes, options_.mesh_scale);
    placed.fixed = readMeshes(options_.fixed_meshes, options_.mesh_scale);
    GuardSimulationOptions simulation = options_.simulation;
    simulation.guard.predictor = options_.predictor;
    if (options_.session_predictor == kCommandPredictor) {
      simulation.guard.predictor.predictor = sweep_guard_core::PredictorOptions{}.predictor;
    } else {
      simulation.guard.predictor.predictor = options_.session_predictor;
      for (Recording& recording : recordings_) recording.commands.clear();
    }
    std::vector<Sessions> sessions = withProgress(
        "sessions", [&](const Progress& progress) { return runSessions(recordings_, placed, simulation, progress); });
    simulation.limits.thresholds = options_.session_thresholds;
    if (options_.wantsCalibration()) reportCalibration(sessions, simulation.limits);
    report(countSessions(sessions, simulation.limits));
    if (options_.tune) tune(tuningCurve(sessions, simulation.limits));
  }

 private:
  void tune(const std::vector<TuningPoint>& points) {
    if (tune_csv_.requested()) tune_csv_.write(tuningCsv(points, *options_.tune));
    std::cout << tuningText(points, *options_.tune);
  }

  void reportCalibration(const std::vector<Sessions>& sessions, const sweep_guard_core::WarningLimits& limits) {
    const std::vector<IntervalCalibration> calibrations = calibrate(sessions, limits);
    if (calibration_csv_.requested()) calibration_csv_.write(calibrationCsv(calibrations));
    std::cout << calibrationTable(calibrations) << '\n';
  }

  void report(const std::vector<RecordingSessions>& sessions) {
    if (sessions_csv_.requested()) sessions_csv_.write(sessionsCsv(sessions));
    if (sessions_objects_csv_.requested()) sessions_objects_csv_.write(sessionObjectsCsv(sessions));
    std::cout << sessionsTable(sessions) << '\n';
    if (options_.compare_sessions.empty()) return;
    std::cout << sessionsComparison(sessions, sessions_before_) << '\n';
  }

  const Options& options_;
  std::vector<Recording> recordings_;
  OutputFile csv_;
  OutputFile warnings_csv_;
  OutputFile tradeoff_csv_;
  OutputFile sessions_csv_;
  OutputFile sessions_objects_csv_;
  OutputFile tune_csv_;
  OutputFile calibration_csv_;
  std::vector<RecordingSessions> sessions_before_;
  size_t steps_ = 0;
};

int run(int argc, char** argv) {
  const Options options = parseOptions(argc, argv);
  if (options.help) {
    std::cout << usage();
    return 0;
  }
  Evaluation evaluation(options);
  if (options.wantsErrors()) evaluation.evaluateErrors();
  if (options.wantsWarnings()) evaluation.evaluateWarnings();
  if (options.wantsSessions()) evaluation.evaluateSessions();
  return 0;
}

}  // namespace
}  // namespace sweep_guard_evaluation

int main(int argc, char** argv) {
  return sweep_guard_core::runProgram("evaluate_prediction", [&] { return sweep_guard_evaluation::run(argc, argv); });
}
