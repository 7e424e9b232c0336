#pragma once

#include <vector>

#include "evaluation/progress.h"
#include "evaluation/recorded_motion.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_evaluation {

/// Returns the poses at which predictions are compared with the motion: those with `history` before and `future` after
/// them without a gap. Of poses with equal stamps only the first can be a sample.
/// @param poses  of `motion`, including those with equal stamps
/// @return indices of `poses`, ascending
std::vector<size_t> samplesOf(const std::vector<sweep_guard_core::StampedPose>& poses, const RecordedMotion& motion,
                              sweep_guard_core::Duration history, sweep_guard_core::Duration future);

/// Errors of one predictor at one horizon: one per sample, NaN if there was no prediction.
struct ErrorsAhead {
  std::vector<float> position;  ///< distance [m]
  std::vector<float> rotation;  ///< angle [rad], in [0, pi]
};

/// A motion and the poses at which predictions are compared with it.
struct SampledMotion {
  const std::vector<sweep_guard_core::StampedPose>& poses;
  RecordedMotion motion;        ///< of the poses
  std::vector<size_t> samples;  ///< indices of poses, ascending
  /// What goes to the robot; null: the predictor is not told.
  const std::vector<sweep_guard_core::StampedPose>* commands = nullptr;
};

/// Passes every pose to a predictor and compares its prediction at each sample with the motion.
/// @param horizons  ascending, > 0; within the motion at every sample
/// @return one for each horizon
std::vector<ErrorsAhead> predictionErrors(const SampledMotion& sampled,
                                          const std::vector<sweep_guard_core::Duration>& horizons,
                                          const sweep_guard_core::PredictorOptions& options, const Progress& progress);

/// Median and 95th percentile; NaN without samples.
struct ErrorSummary {
  double position_median;  ///< [m]
  double position_p95;     ///< [m]
  double rotation_median;  ///< [rad]
  double rotation_p95;     ///< [rad]
  size_t samples;
};

/// Summarizes the errors of all predictors over the samples at which every predictor has a prediction.
/// @param errors  by predictor, then by horizon
/// @return by predictor, then by horizon
std::vector<std::vector<ErrorSummary>> summaries(const std::vector<std::vector<ErrorsAhead>>& errors);

}  // namespace sweep_guard_evaluation
