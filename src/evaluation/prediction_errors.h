#pragma once

#include <functional>
#include <vector>

#include "evaluation/recorded_motion.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_evaluation {

/// Told how many more poses have been dealt with; from any thread.
using Progress = std::function<void(size_t)>;

/// Where predictions are compared with what came: poses that have so much of the recording before and after them
/// without a gap. Of poses that share a stamp the first may be one; the others are fed to the predictor, no more.
/// @param poses  of `motion`, those that share a stamp included
/// @returns indices of `poses`, ascending
std::vector<size_t> samplesOf(const std::vector<sweep_guard_core::StampedPose>& poses, const RecordedMotion& motion,
                              sweep_guard_core::Duration history, sweep_guard_core::Duration future);

/// Errors of one predictor at one horizon, one per sample, NaN where it predicted nothing.
struct ErrorsAhead {
  std::vector<float> position;  ///< distance [m]
  std::vector<float> rotation;  ///< angle [rad], in [0, pi]
};

/// Feeds every pose to a predictor, in their order, and compares what it expects after each sample with the motion.
/// @param horizons  ascending, > 0; the motion goes on for as long after every sample
/// @returns one for each horizon
std::vector<ErrorsAhead> predictionErrors(const std::vector<sweep_guard_core::StampedPose>& poses,
                                          const RecordedMotion& motion, const std::vector<size_t>& samples,
                                          const std::vector<sweep_guard_core::Duration>& horizons,
                                          const sweep_guard_core::PredictorOptions& options, const Progress& progress);

/// Median and 95th percentile; NaN if there is no sample.
struct ErrorSummary {
  double position_median;  ///< [m]
  double position_p95;     ///< [m]
  double rotation_median;  ///< [rad]
  double rotation_p95;     ///< [rad]
  size_t samples;
};

/// Judges predictors on the same samples: those at which each of them predicted.
/// @param errors  by predictor, then by horizon
/// @returns by predictor, then by horizon
std::vector<std::vector<ErrorSummary>> summaries(const std::vector<std::vector<ErrorsAhead>>& errors);

}  // namespace sweep_guard_evaluation
