#pragma once

#include <string>
#include <vector>

#include "evaluation/calibration.h"
#include "evaluation/sessions.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_evaluation {

/// Ways to turn deviations into a probability.
enum class Scale {
  kPlane,   ///< contactProbability(): that of one plane
  kGuard,   ///< probabilityWithin()
  kOthers,  ///< fitted to the other recordings
};

/// The outcomes of the predictions for one interval.
struct IntervalCalibration {
  sweep_guard_core::PredictionInterval interval;
  sweep_guard_core::Duration length;
  std::vector<std::string> recordings;
  std::vector<std::vector<PredictionOutcome>> outcomes;  ///< by recording

  /// Returns the forecasts of a recording.
  std::vector<PredictionOutcome> forecasts(Scale scale, size_t recording) const;
  /// Returns the forecasts of all recordings.
  std::vector<PredictionOutcome> forecasts(Scale scale) const;
};

/// Returns the calibration of both intervals.
/// @param limits  that name the intervals
std::vector<IntervalCalibration> calibrate(const std::vector<Sessions>& sessions,
                                           const sweep_guard_core::WarningLimits& limits);

/// Returns tables for the terminal: figures of each recording and of all, by scale; the bins of all; and the knots of
/// probabilityWithin() that fit all recordings.
std::string calibrationTable(const std::vector<IntervalCalibration>& calibrations);

/// Returns a CSV file of the bins of all recordings with the columns within_s,scale,probability,frequency.
std::string calibrationCsv(const std::vector<IntervalCalibration>& calibrations);

}  // namespace sweep_guard_evaluation
