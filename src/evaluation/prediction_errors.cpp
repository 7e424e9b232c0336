#include "evaluation/prediction_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep_guard/common/quantile.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::Duration;
using sweep_guard_core::PosePredictor;
using sweep_guard_core::PredictedPath;
using sweep_guard_core::quantile;
using sweep_guard_core::StampedPose;

namespace {

constexpr size_t kProgressStep = 256;

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::Quaterniond(a.linear()).angularDistance(Eigen::Quaterniond(b.linear()));
}

class Comparison {
 public:
  Comparison(const RecordedMotion& motion, const std::vector<Duration>& horizons, size_t samples)
      : motion_(motion), horizons_(horizons), errors_(horizons.size()) {
    for (ErrorsAhead& ahead : errors_) {
      ahead.position.reserve(samples);
      ahead.rotation.reserve(samples);
    }
  }

  void add(sweep_guard_core::Time stamp, const PredictedPath& path) {
    for (size_t i = 0; i < horizons_.size(); ++i) {
      if (path.empty()) {
        addTo(errors_[i], std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN());
        continue;
      }
      const Eigen::Isometry3d came = motion_.at(stamp + horizons_[i]);
      const double distance = (path[i].X_WT.translation() - came.translation()).norm();
      addTo(errors_[i], distance, angleBetween(path[i].X_WT, came));
    }
  }

  std::vector<ErrorsAhead> errors() && { return std::move(errors_); }

 private:
  static void addTo(ErrorsAhead& errors, double position, double rotation) {
    errors.position.push_back(static_cast<float>(position));
    errors.rotation.push_back(static_cast<float>(rotation));
  }

  const RecordedMotion& motion_;
  const std::vector<Duration>& horizons_;
  std::vector<ErrorsAhead> errors_;
};

std::vector<double> keptOf(const std::vector<float>& errors, const std::vector<bool>& kept) {
  std::vector<double> sample;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (kept[i]) sample.push_back(errors[i]);
  }
  return sample;
}

std::vector<bool> predictedByAll(const std::vector<std::vector<ErrorsAhead>>& errors) {
  std::vector<bool> kept(errors.front().front().position.size(), true);
  for (const std::vector<ErrorsAhead>& of_one : errors) {
    const std::vector<float>& position = of_one.front().position;  // all horizons are predicted, or none
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
    if (motion.unbroken(stamp - history, stamp + future)) samples.push_back(i);
  }
  return samples;
}

std::vector<ErrorsAhead> predictionErrors(const std::vector<StampedPose>& poses, const RecordedMotion& motion,
                                          const std::vector<size_t>& samples, const std::vector<Duration>& horizons,
                                          const sweep_guard_core::PredictorOptions& options, const Progress& progress) {
  PosePredictor predictor(options);
  Comparison comparison(motion, horizons, samples.size());
  auto sample = samples.begin();
  for (size_t i = 0; i < poses.size(); ++i) {
    predictor.observe(poses[i]);
    if (sample != samples.end() && *sample == i) {
      comparison.add(poses[i].stamp, predictor.predict(horizons));
      ++sample;
    }
    if ((i + 1) % kProgressStep == 0) progress(kProgressStep);
  }
  progress(poses.size() % kProgressStep);
  return std::move(comparison).errors();
}

std::vector<std::vector<ErrorSummary>> summaries(const std::vector<std::vector<ErrorsAhead>>& errors) {
  const std::vector<bool> kept = predictedByAll(errors);
  std::vector<std::vector<ErrorSummary>> all;
  for (const std::vector<ErrorsAhead>& of_one : errors) {
    all.emplace_back();
    for (const ErrorsAhead& ahead : of_one) {
      const std::vector<double> position = keptOf(ahead.position, kept);
      const std::vector<double> rotation = keptOf(ahead.rotation, kept);
      all.back().push_back({quantile(position, 0.5), quantile(position, 0.95), quantile(rotation, 0.5),
                            quantile(rotation, 0.95), position.size()});
    }
  }
  return all;
}

}  // namespace sweep_guard_evaluation
