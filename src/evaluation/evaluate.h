#pragma once

#include <vector>

#include "evaluation/error_report.h"
#include "evaluation/options.h"
#include "evaluation/warning_report.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// The errors ahead of every predictor on every recording, where there is 1 s before and 1 s (or the longest horizon)
/// after without a gap.
/// @param horizons  ascending, > 0
std::vector<ErrorReport> reportErrors(const std::vector<sweep_guard_recording::Recording>& recordings,
                                      const Options& options, const std::vector<sweep_guard_core::Duration>& horizons,
                                      const Progress& progress);

/// What warnings are worth with every predictor on every recording: at the threshold asked for, and at all those of the
/// trade-off if that is wanted.
std::vector<WarningReport> reportWarnings(const std::vector<sweep_guard_recording::Recording>& recordings,
                                          const Options& options, const Progress& progress);

}  // namespace sweep_guard_evaluation
