#pragma once

#include <string>
#include <vector>

#include "evaluation/prediction_errors.h"

namespace sweep_guard_evaluation {

/// The errors of several predictors on one recording, on the same samples.
struct ErrorReport {
  std::string recording;
  std::vector<std::string> predictors;
  std::vector<sweep_guard_core::Duration> horizons;
  std::vector<std::vector<ErrorSummary>> errors;  ///< by predictor, then by horizon
};

/// The report on some of its horizons.
ErrorReport atHorizons(const ErrorReport& report, const std::vector<sweep_guard_core::Duration>& horizons);

/// recording,predictor,horizon_s,position_median_m,position_p95_m,rotation_median_rad,rotation_p95_rad,samples
std::string errorCsv(const std::vector<ErrorReport>& reports);

/// For a reader: medians and 95th percentiles, and their ratios to the better of `hold` and `constant_velocity` where
/// those are among the predictors.
std::string errorTable(const ErrorReport& report);

/// A script for gnuplot that draws error against horizon: one row of panels for each recording, position and rotation,
/// one colour for each predictor.
/// @param path  of the PNG file
std::string errorPlot(const std::vector<ErrorReport>& reports, const std::string& path);

}  // namespace sweep_guard_evaluation
