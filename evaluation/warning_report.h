#pragma once

#include <string>
#include <vector>

#include "evaluation/alarm_statistics.h"

namespace sweep_guard_evaluation {

/// Leads and false alarms of several predictors on one recording, with the same placements.
struct WarningReport {
  std::string recording;
  size_t placements = 0;
  std::vector<std::string> predictors;
  std::vector<double> min_probabilities;  ///< thresholds, ascending
  size_t chosen = 0;                      ///< index of the threshold that the guard uses
  /// By predictor, by threshold, then in the order of alarmRules().
  std::vector<std::vector<std::array<AlarmStatistics, 2>>> statistics;

  const AlarmStatistics& considered(size_t predictor, size_t threshold) const {
    return statistics[predictor][threshold].back();
  }
};

/// Returns the leads at which warnings are compared [s].
const std::vector<double>& comparedLeads();

/// Returns a CSV file for the chosen threshold with the columns
/// recording,predictor,interval,contacts,warned,lead_median_s,lead_p5_s,false_alarms_per_min.
std::string warningCsv(const std::vector<WarningReport>& reports);

/// Returns the same as a table for the terminal, with the shares of contacts warned of in time.
std::string warningTable(const WarningReport& report);

}  // namespace sweep_guard_evaluation
