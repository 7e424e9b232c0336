#include "evaluation/profile_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "evaluation/evaluate.h"
#include "evaluation/parallel.h"
#include "prediction/profile.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::PosePredictor;
using sweep_guard_core::PredictorOptions;
using sweep_guard_core::Profile;
using sweep_guard_core::StampedPose;
using sweep_guard_recording::Recording;

namespace {

constexpr Duration kBegin = std::chrono::seconds(20);
constexpr size_t kOwn = 3;  // predictor of a report

using Profiles = std::vector<std::shared_ptr<const Profile>>;  // of the first halves

// The second half of a recording, and who predicts it.
struct Trial {
  std::vector<StampedPose> poses;
  RecordedMotion motion;
  std::vector<size_t> samples;
  std::vector<std::string> names;
  std::vector<PredictorOptions> predictors;
  std::vector<std::vector<ErrorsAhead>> errors;  // by predictor, then by horizon
};

// Samples of a trial.
struct Window {
  std::string name;
  std::ptrdiff_t begin;
  std::ptrdiff_t end;
};

sweep_guard_core::Time middleOf(const std::vector<StampedPose>& poses) {
  return poses.front().stamp + (poses.back().stamp - poses.front().stamp) / 2;
}

// The first pose of the second half.
auto secondHalf(const std::vector<StampedPose>& poses) {
  const auto earlier = [](const StampedPose& pose, sweep_guard_core::Time time) { return pose.stamp < time; };
  return std::lower_bound(poses.begin(), poses.end(), middleOf(poses), earlier);
}

// By way of its text, as the node takes it.
std::shared_ptr<const Profile> learn(const std::vector<StampedPose>& poses, const Progress& progress) {
  PosePredictor predictor{PredictorOptions()};
  const auto end = secondHalf(poses);
  std::for_each(poses.begin(), end, [&](const StampedPose& pose) { predictor.observe(pose); });
  progress(static_cast<size_t>(end - poses.begin()));
  return std::make_shared<Profile>(sweep_guard_core::profileFromText(toText(*predictor.profile())));
}

std::vector<float> part(const std::vector<float>& errors, const Window& window) {
  return {errors.begin() + window.begin, errors.begin() + window.end};
}

void addPredictor(Trial& trial, const PredictorOptions& options, const std::string& predictor,
                  const std::string& teacher = "", std::shared_ptr<const Profile> profile = nullptr) {
  trial.names.push_back(predictor + teacher);
  trial.predictors.push_back(options);
  trial.predictors.back().predictor = predictor;
  trial.predictors.back().profile = std::move(profile);
}

Trial trialOf(size_t of, const std::vector<Recording>& recordings, const Profiles& profiles, const Options& options) {
  const std::vector<StampedPose>& poses = recordings[of].poses;
  std::vector<StampedPose> second(secondHalf(poses), poses.end());
  RecordedMotion motion(second);
  std::vector<size_t> samples = samplesOf(second, motion, kHistory, std::max(kFuture, options.horizons.back()));
  Trial trial{std::move(second), std::move(motion), std::move(samples), {}, {}, {}};
  for (const char* const name : {"hold", "constant_velocity", "direct"}) addPredictor(trial, options.predictor, name);
  addPredictor(trial, options.predictor, "direct", " own", profiles[of]);
  for (size_t other = 0; other < recordings.size(); ++other) {
    if (other != of) addPredictor(trial, options.predictor, "direct", " " + recordings[other].name, profiles[other]);
  }
  trial.errors.resize(trial.predictors.size());
  return trial;
}

ErrorReport reportOf(const std::string& recording, const Trial& trial, const std::vector<Duration>& horizons,
                     const Window& window) {
  std::vector<std::vector<ErrorsAhead>> errors(trial.errors.size());
  for (size_t i = 0; i < errors.size(); ++i) {
    for (const ErrorsAhead& ahead : trial.errors[i]) {
      errors[i].push_back({part(ahead.position, window), part(ahead.rotation, window)});
    }
  }
  return {recording + ", " + window.name, trial.names, horizons, summaries(errors)};
}

std::vector<Window> windowsOf(const Trial& trial) {
  const auto end = trial.poses.front().stamp + kBegin;
  const auto count = static_cast<std::ptrdiff_t>(trial.samples.size());
  const auto first = std::count_if(trial.samples.begin(), trial.samples.end(),
                                   [&](size_t sample) { return trial.poses[sample].stamp <= end; });
  return {{"first 20 s", 0, first}, {"after 20 s", first, count}, {"second half", 0, count}};
}

}  // namespace

std::vector<ErrorReport> reportProfiles(const std::vector<Recording>& recordings, const Options& options,
                                        const Progress& progress) {
  Profiles profiles(recordings.size());
  inParallel(recordings.size(), [&](size_t i) { profiles[i] = learn(recordings[i].poses, progress); });
  std::vector<Trial> trials;
  for (size_t i = 0; i < recordings.size(); ++i) trials.push_back(trialOf(i, recordings, profiles, options));
  const size_t count = trials.front().predictors.size();
  inParallel(trials.size() * count, [&](size_t task) {
    Trial& trial = trials[task / count];
    const size_t i = task % count;
    trial.errors[i] =
        predictionErrors({trial.poses, trial.motion, trial.samples, options.horizons, trial.predictors[i]}, progress);
  });
  std::vector<ErrorReport> reports;
  for (size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].samples.empty()) {
      throw sweep_guard_core::InvalidInput(recordings[i].name + ": no motion without a gap; give a longer recording");
    }
    for (const Window& window : windowsOf(trials[i])) {
      if (window.begin < window.end) {
        reports.push_back(reportOf(recordings[i].name, trials[i], options.horizons, window));
      }
    }
  }
  return reports;
}

size_t profileSteps(const std::vector<Recording>& recordings) {
  size_t steps = 0;
  for (const Recording& recording : recordings) {
    const auto second = static_cast<size_t>(recording.poses.end() - secondHalf(recording.poses));
    steps += recording.poses.size() + (kOwn + recordings.size() - 1) * second;
  }
  return steps;
}

std::string profileTable(const std::vector<ErrorReport>& reports) {
  std::string table =
      fmt::format("mean error relative to the better of hold and constant_velocity\n  {:<45} {:>9} {:>9} {:>9} {:>9}\n",
                  "`direct` with the profile", "none", "own", "others'", "worst");
  for (const ErrorReport& report : reports) {
    double sum = 0.0;
    double worst = 0.0;
    for (size_t other = kOwn + 1; other < report.predictors.size(); ++other) {
      sum += meanRatio(report, other);
      worst = std::max(worst, meanRatio(report, other));
    }
    table += fmt::format("  {:<45} {:>9.3f} {:>9.3f}", report.recording, meanRatio(report, kOwn - 1),
                         meanRatio(report, kOwn));
    const auto others = static_cast<double>(report.predictors.size() - kOwn - 1);
    if (others > 0.0) table += fmt::format(" {:>9.3f} {:>9.3f}", sum / others, worst);
    table += '\n';
  }
  return table;
}

}  // namespace sweep_guard_evaluation
