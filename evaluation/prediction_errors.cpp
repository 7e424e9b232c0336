#include "evaluation/prediction_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/command_feed.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::PredictedPath;
using sweep_guard_core::quantile;
using sweep_guard_core::StampedPose;

namespace {

constexpr size_t kProgressStep = 256;

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

void addErrors(const RecordedMotion& motion, const std::vector<Duration>& horizons, sweep_guard_core::Time stamp,
               const PredictedPath& path, std::vector<ErrorsAhead>& errors) {
  for (size_t i = 0; i < horizons.size(); ++i) {
    errors[i].position.push_back(std::numeric_limits<float>::quiet_NaN());
    errors[i].rotation.push_back(std::numeric_limits<float>::quiet_NaN());
    if (path.empty()) continue;
    const Eigen::Isometry3d measured = motion.at(stamp + horizons[i]);
    errors[i].position.back() = static_cast<float>((path[i].X_WT.translation() - measured.translation()).norm());
    errors[i].rotation.back() = static_cast<float>(angleBetween(path[i].X_WT, measured));
  }
}

std::vector<double> keptErrors(const std::vector<float>& errors, const std::vector<bool>& kept) {
  std::vector<double> sample;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (kept[i]) sample.push_back(errors[i]);
  }
  return sample;
}

std::vector<bool> predictedByAll(const std::vector<std::vector<ErrorsAhead>>& errors) {
  std::vector<bool> kept(errors.front().front().position.size(), true);
  for (const std::vector<ErrorsAhead>& of_predictor : errors) {
    const std::vector<float>& position = of_predictor.front().position;  // a prediction covers all horizons
    for (size_t i = 0; i < kept.size(); ++i) kept[i] = kept[i] && !std::isnan(position[i]);
  }
  return kept;
}

}  // namespace

std::vector<size_t> samplesOf(const std::vector<StampedPose>& poses, const RecordedMotion& motion, Duration history,
                              Duration future) {
  std::vector<size_t> samples;
  for (size_t i = 0; i < poses.size(); ++i) {
    const sweep_guard_core::Time stamp = poses[i].stamp;
    if (i > 0 && poses[i - 1].stamp == stamp) continue;
    if (motion.isContinuous(stamp - history, stamp + future)) samples.push_back(i);
  }
  return samples;
}

std::vector<ErrorsAhead> predictionErrors(const SampledMotion& sampled, const std::vector<Duration>& horizons,
                                          const sweep_guard_core::PredictorOptions& options, const Progress& progress) {
  const std::vector<StampedPose>& poses = sampled.poses;
  sweep_guard_core::PosePredictor predictor(options);
  sweep_guard_core::PredictedPath path;
  std::vector<ErrorsAhead> errors(horizons.size());
  auto sample = sampled.samples.begin();
  CommandFeed commands(sampled.commands);
  for (size_t i = 0; i < poses.size(); ++i) {
    commands.sendUntil(poses[i].stamp, predictor);
    predictor.observe(poses[i]);
    if (sample != sampled.samples.end() && *sample == i) {
      predictor.predict(horizons, path);
      addErrors(sampled.motion, horizons, poses[i].stamp, path, errors);
      ++sample;
    }
    if ((i + 1) % kProgressStep == 0) progress(kProgressStep);
  }
  progress(poses.size() % kProgressStep);
  return errors;
}

std::vector<std::vector<ErrorSummary>> summaries(const std::vector<std::vector<ErrorsAhead>>& errors) {
  const std::vector<bool> kept = predictedByAll(errors);
  std::vector<std::vector<ErrorSummary>> all;
  for (const std::vector<ErrorsAhead>& of_predictor : errors) {
    all.emplace_back();
    for (const ErrorsAhead& ahead : of_predictor) {
      const std::vector<double> position = keptErrors(ahead.position, kept);
      const std::vector<double> rotation = keptErrors(ahead.rotation, kept);
      all.back().push_back({quantile(position, 0.5), quantile(position, 0.95), quantile(rotation, 0.5),
                            quantile(rotation, 0.95), position.size()});
    }
  }
  return all;
}

}  // namespace sweep_guard_evaluation
