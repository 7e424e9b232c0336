#pragma once

#include <string>
#include <vector>

#include "evaluation/error_report.h"
#include "evaluation/options.h"
#include "recording/recording.h"

namespace sweep_guard_evaluation {

/// Computes errors on the second half of each recording, as reportErrors() does: of `hold`, `constant_velocity`, `direct`
/// that begins with nothing, `direct` with the profile that it learned on the first half, and `direct` with the profiles
/// of the first halves of all other recordings.
/// @return three reports for each recording: the first 20 s of the second half, the rest if there is any, and the whole half
/// @throws sweep_guard_core::InvalidInput if a second half has no sample
std::vector<ErrorReport> reportProfiles(const std::vector<sweep_guard_recording::Recording>& recordings,
                                        const Options& options, const Progress& progress);

/// Returns the number of poses that reportProfiles() passes to predictors.
size_t profileSteps(const std::vector<sweep_guard_recording::Recording>& recordings);

/// Returns a table for the terminal: meanRatio() without a profile, with that of the first half, and with those of the
/// other recordings: mean and worst.
std::string profileTable(const std::vector<ErrorReport>& reports);

}  // namespace sweep_guard_evaluation
