#include <fstream>
#include <iostream>
#include <set>

#include "evaluation/error_report.h"
#include "evaluation/gnuplot.h"
#include "evaluation/options.h"
#include "evaluation/parallel.h"
#include "evaluation/progress_bar.h"
#include "recording/recording.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {
namespace {

using std::chrono::milliseconds;
using sweep_guard::Duration;
using sweep_guard::InvalidInput;
using sweep_guard_recording::Recording;

constexpr Duration kHistory = std::chrono::seconds(1);
constexpr Duration kFuture = std::chrono::seconds(1);

/// A file that is written at the end, but refused at the beginning if it cannot be.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path) : path_(path) {
    if (path.empty()) return;
    stream_.open(path);
    if (!stream_) throw InvalidInput(path + ": cannot be written; check folder and permissions");
  }
  bool wanted() const { return !path_.empty(); }
  const std::string& path() const { return path_; }
  void write(const std::string& text) {
    stream_ << text << std::flush;
    if (!stream_) throw InvalidInput(path_ + ": cannot be written; is the disk full?");
  }

 private:
  std::string path_;
  std::ofstream stream_;
};

std::vector<Recording> readAll(const Options& options) {
  std::vector<Recording> recordings(options.files.size());
  inParallel(options.files.size(),
             [&](size_t i) { recordings[i] = sweep_guard_recording::readRecording(options.files[i], options.topic); });
  return recordings;
}

std::vector<Duration> withPlotted(const std::vector<Duration>& horizons) {
  std::set<Duration> all(horizons.begin(), horizons.end());
  for (const int ms : {20, 30, 40, 60, 80, 100, 140, 200, 280, 400, 500, 560, 700, 800, 900, 1000}) {
    all.insert(milliseconds(ms));
  }
  return {all.begin(), all.end()};
}

/// A recording with what all predictors are judged on.
struct Case {
  Case(const Recording& of, Duration future)
      : recording(of), motion(of.poses), samples(samplesOf(of.poses, motion, kHistory, future)) {}

  const Recording& recording;
  RecordedMotion motion;
  std::vector<size_t> samples;
  std::vector<std::vector<ErrorsAhead>> errors;  // by predictor, then by horizon
};

sweep_guard::PredictorOptions named(sweep_guard::PredictorOptions options, const std::string& predictor) {
  options.predictor = predictor;
  return options;
}

std::vector<ErrorReport> reportErrors(const std::vector<Recording>& recordings, const Options& options,
                                      const std::vector<Duration>& horizons, const Progress& progress) {
  std::vector<Case> cases;
  for (const Recording& recording : recordings) {
    cases.emplace_back(recording, std::max(kFuture, horizons.back()));
    cases.back().errors.resize(options.predictors.size());
  }
  inParallel(cases.size() * options.predictors.size(), [&](size_t i) {
    Case& of = cases[i / options.predictors.size()];
    const size_t predictor = i % options.predictors.size();
    of.errors[predictor] = predictionErrors(of.recording.poses, of.motion, of.samples, horizons,
                                            named(options.predictor, options.predictors[predictor]), progress);
  });
  std::vector<ErrorReport> reports;
  for (const Case& of : cases)
    reports.push_back({of.recording.name, options.predictors, horizons, summaries(of.errors)});
  return reports;
}

size_t countPoses(const std::vector<Recording>& recordings) {
  size_t poses = 0;
  for (const Recording& recording : recordings) poses += recording.poses.size();
  return poses;
}

int run(const Options& options) {
  if (!options.plot.empty()) requireGnuplot();
  OutputFile csv(options.csv);
  const OutputFile plot(options.plot);
  const std::vector<Recording> recordings = readAll(options);
  const std::vector<Duration> horizons = plot.wanted() ? withPlotted(options.horizons) : options.horizons;
  std::vector<ErrorReport> reports;
  {
    ProgressBar bar(countPoses(recordings) * options.predictors.size());
    reports = reportErrors(recordings, options, horizons, [&](size_t poses) { bar.advance(poses); });
  }
  if (plot.wanted()) runGnuplot(errorPlot(reports, plot.path()));
  for (ErrorReport& report : reports) report = atHorizons(report, options.horizons);
  if (csv.wanted()) csv.write(errorCsv(reports));
  for (const ErrorReport& report : reports) std::cout << errorTable(report) << '\n';
  return 0;
}

}  // namespace
}  // namespace sweep_guard_evaluation

int main(int argc, char** argv) {
  using namespace sweep_guard_evaluation;
  try {
    const Options options = parseOptions(argc, argv);
    if (options.help) {
      std::cout << usage();
      return 0;
    }
    return run(options);
  } catch (const std::exception& error) {
    std::cerr << "evaluate_prediction: " << error.what() << std::endl;
    return 2;
  }
}
