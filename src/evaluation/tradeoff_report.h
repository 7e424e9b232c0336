#pragma once

#include <string>
#include <vector>

#include "evaluation/warning_report.h"

namespace sweep_guard_evaluation {

/// The thresholds that a trade-off is drawn over: from 0.001, below which a probability is taken for 0, to 1, where
/// nothing but the predicted path itself warns. The one chosen is among them.
std::vector<double> tradeoffThresholds(double chosen);

/// How much a predictor warns for how many false alarms: the largest share of contacts that some threshold gives at
/// least `lead` ahead [s] at no more than x false alarms per minute, averaged over x from 0 to `most_false_alarms` (the
/// area under the curve, divided by its width). 1 is the best; where no threshold gives so few false alarms, the share
/// is 0. NaN without contacts.
double meanShareWarned(const WarningReport& report, size_t predictor, double lead, double most_false_alarms);

/// Of all thresholds: recording,predictor,min_probability,false_alarms_per_min,warned_0.1,warned_0.5,warned_1.0
std::string tradeoffCsv(const std::vector<WarningReport>& reports);

/// meanShareWarned() of all predictors.
std::string tradeoffTable(const WarningReport& report, double most_false_alarms);

/// A script for gnuplot that draws the share of contacts warned of in time against false alarms per minute: one row of
/// panels for each recording, one column for each lead, one curve for each predictor, the threshold chosen marked.
/// @param path  of the PNG file
std::string tradeoffPlot(const std::vector<WarningReport>& reports, const std::string& path);

}  // namespace sweep_guard_evaluation
