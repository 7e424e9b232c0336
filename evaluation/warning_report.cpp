#include "evaluation/warning_report.h"

#include <fmt/format.h>

#include "common/csv.h"
#include "sweep_guard/common/quantile.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::quantile;

namespace {

std::string tableLine(const AlarmRule& rule, const AlarmStatistics& statistics) {
  std::string line =
      fmt::format("{:<10} {:4} of {:<4} {:6.2f} {:6.2f}", rule.interval, statistics.leads.size(), statistics.contacts,
                  quantile(statistics.leads, 0.5), quantile(statistics.leads, 0.05));
  for (const double lead : comparedLeads()) line += fmt::format("  {:5.1f} %", 100.0 * statistics.warnedAhead(lead));
  return line + fmt::format("  {:8.2f}\n", statistics.falseAlarmsPerMinute());
}

}  // namespace

const std::vector<double>& comparedLeads() {
  static const std::vector<double> kLeads = {0.1, 0.5, 1.0};
  return kLeads;
}

std::string warningCsv(const std::vector<WarningReport>& reports) {
  std::string csv = csvLine({"recording", "predictor", "interval", "contacts", "warned", "lead_median_s", "lead_p5_s",
                             "false_alarms_per_min"});
  for (const WarningReport& report : reports) {
    for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
      for (size_t rule = 0; rule < alarmRules().size(); ++rule) {
        const AlarmStatistics& statistics = report.statistics[predictor][report.chosen][rule];
        csv += csvLine({report.recording, report.predictors[predictor], alarmRules()[rule].interval,
                        std::to_string(statistics.contacts), std::to_string(statistics.leads.size()),
                        csvNumber(quantile(statistics.leads, 0.5)), csvNumber(quantile(statistics.leads, 0.05)),
                        csvNumber(statistics.falseAlarmsPerMinute())});
      }
    }
  }
  return csv;
}

std::string warningTable(const WarningReport& report) {
  std::string table = fmt::format(
      "{}, {} placements, warnings at a probability of {:g}:\n"
      "  predictor         interval   contacts    lead [s]       contacts warned of at least      false alarms\n"
      "                               warned of   median    5%      0.1 s    0.5 s    1.0 s ahead   per min\n",
      report.recording, report.placements, report.min_probabilities[report.chosen]);
  for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
    for (size_t rule = 0; rule < alarmRules().size(); ++rule) {
      table += fmt::format("  {:<17} ", report.predictors[predictor]) +
               tableLine(alarmRules()[rule], report.statistics[predictor][report.chosen][rule]);
    }
  }
  return table;
}

}  // namespace sweep_guard_evaluation
