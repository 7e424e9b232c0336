#pragma once

#include <string>
#include <vector>

#include "evaluation/prediction_errors.h"

namespace sweep_guard_evaluation {

/// Errors of several predictors on one recording, on the same samples.
struct ErrorReport {
  std::string recording;
  std::vector<std::string> predictors;
  std::vector<sweep_guard_core::Duration> horizons;
  std::vector<std::vector<ErrorSummary>> errors;  ///< by predictor, then by horizon
};

/// Returns a CSV file with the columns
/// recording,predictor,horizon_s,position_median_m,position_p95_m,rotation_median_rad,rotation_p95_rad,samples.
std::string errorCsv(const std::vector<ErrorReport>& reports);

/// Returns a table for the terminal: medians and 95th percentiles, with their ratios to the better of `hold` and
/// `constant_velocity` if both are among the predictors.
std::string errorTable(const ErrorReport& report);

}  // namespace sweep_guard_evaluation
