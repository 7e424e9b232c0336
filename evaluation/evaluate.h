#pragma once

#include <vector>

#include "evaluation/error_report.h"
#include "evaluation/options.h"
#include "evaluation/warning_report.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// A sample has this much motion before and after it without a gap.
constexpr sweep_guard_core::Duration kHistory = std::chrono::seconds(1);
constexpr sweep_guard_core::Duration kFuture = std::chrono::seconds(1);

/// Computes the prediction errors of every predictor on every recording. Samples have 1 s before and 1 s (or the
/// longest horizon, if it is longer) after them without a gap.
std::vector<ErrorReport> reportErrors(const std::vector<sweep_guard_recording::Recording>& recordings,
                                      const Options& options, const Progress& progress);

/// Computes leads and false alarms of every predictor on every recording, at the requested threshold and, if a
/// trade-off is requested, at all its thresholds.
std::vector<WarningReport> reportWarnings(const std::vector<sweep_guard_recording::Recording>& recordings,
                                          const Options& options, const Progress& progress);

}  // namespace sweep_guard_evaluation
