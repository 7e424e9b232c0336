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

/// Returns the report reduced to some of its horizons.
ErrorReport atHorizons(const ErrorReport& report, const std::vector<sweep_guard_core::Duration>& horizons);

/// Returns a CSV file with the columns
/// recording,predictor,horizon_s,position_median_m,position_p95_m,rotation_median_rad,rotation_p95_rad,samples.
std::string errorCsv(const std::vector<ErrorReport>& reports);

/// Returns a table for the terminal: medians and 95th percentiles, with their ratios to the better of `hold` and
/// `constant_velocity` if both are among the predictors.
std::string errorTable(const ErrorReport& report);

/// Returns a gnuplot script that plots errors against horizons: for each recording a row with a panel for position and
/// a panel for rotation, and one color for each predictor.
/// @param path  of the PNG file
std::string errorPlot(const std::vector<ErrorReport>& reports, const std::string& path);

}  // namespace sweep_guard_evaluation
