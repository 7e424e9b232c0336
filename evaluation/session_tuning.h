#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/session_summary.h"
#include "sweep_guard/monitor/warning.h"

namespace sweep_guard_evaluation {

/// Thresholds, and the figures that they give in the sessions of all recordings.
struct TuningPoint {
  sweep_guard_core::WarningThresholds thresholds;
  SessionCount figures;
};

/// Returns the thresholds to compare: `considered_on` from 0.002 to 1, ascending. `reflex` and `considered_off` stay as in
/// `current`, but `considered_off` does not exceed `considered_on`.
std::vector<sweep_guard_core::WarningThresholds> tuningThresholds(const sweep_guard_core::WarningThresholds& current);

/// Returns the smallest `considered_on` with at most this many unjustified alarms per minute, such that no larger one
/// has more, except the last few: with very small ones, alarms are few because they hardly end. Empty: all have more.
/// @param points  ascending by `considered_on`
std::optional<TuningPoint> choosePoint(const std::vector<TuningPoint>& points, double unjustified_per_min);

/// Returns a CSV file with the columns considered_on,considered_off,reflex_probability,unjustified_per_min,precision,
/// warned_0.1,warned_0.3,warned_0.5,warned_1.0,late,false_on_share,at_most_per_min; the last is the same in each row.
std::string tuningCsv(const std::vector<TuningPoint>& points, double unjustified_per_min);

/// Returns the curve as a table for the terminal, and below it the chosen thresholds as yaml to paste, or what the
/// fewest unjustified alarms are.
std::string tuningText(const std::vector<TuningPoint>& points, double unjustified_per_min);

}  // namespace sweep_guard_evaluation
