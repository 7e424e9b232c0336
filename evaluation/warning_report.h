#pragma once

#include <array>
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

constexpr std::array<double, 3> kComparedLeads = {0.1, 0.5, 1.0};  ///< leads at which warnings are compared [s]

/// Returns a CSV file for the chosen threshold with the columns
/// recording,predictor,interval,contacts,warned,lead_median_s,lead_p5_s,false_alarms_per_min.
std::string warningCsv(const std::vector<WarningReport>& reports);

/// Returns the same as a table for the terminal, with the shares of contacts warned of in time.
std::string warningTable(const WarningReport& report);

/// Returns the thresholds of a trade-off: from 0.001, below which a probability counts as 0, to 1, where only the
/// predicted path warns. Includes `chosen`.
std::vector<double> tradeoffThresholds(double chosen);

/// Returns the area under the trade-off curve of a predictor, divided by its width: the largest share of contacts with
/// a lead of at least `lead` [s] that some threshold gives with at most x false alarms per minute, averaged over x from
/// 0 to `max_false_alarms`. 1 is best. The share is 0 where no threshold gives so few false alarms. NaN without
/// contacts.
double meanShareWarned(const WarningReport& report, size_t predictor, double lead, double max_false_alarms);

/// Returns a CSV file of all thresholds with the columns
/// recording,predictor,min_probability,false_alarms_per_min,warned_0.1,warned_0.5,warned_1.0,chosen; chosen is 1 for the threshold
/// that the guard uses, else 0.
std::string tradeoffCsv(const std::vector<WarningReport>& reports);

/// Returns meanShareWarned() of all predictors as a table for the terminal.
std::string tradeoffTable(const WarningReport& report, double max_false_alarms);

}  // namespace sweep_guard_evaluation
