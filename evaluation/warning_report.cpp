#include "evaluation/warning_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

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
  for (const double lead : kComparedLeads) line += fmt::format("  {:5.1f} %", 100.0 * statistics.warnedAhead(lead));
  return line + fmt::format("  {:8.2f}\n", statistics.falseAlarmsPerMinute());
}

}  // namespace

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

std::vector<double> tradeoffThresholds(double chosen) {
  std::vector<double> thresholds = {0.001, 0.0015, 0.002, 0.003, 0.005, 0.007, 0.01, 0.015, 0.02,  0.03, 0.05,
                                    0.07,  0.1,    0.13,  0.16,  0.2,   0.25,  0.3,  0.34,  0.37,  0.4,  0.42,
                                    0.44,  0.46,   0.47,  0.48,  0.49,  0.495, 0.5,  1.0,   chosen};
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  return thresholds;
}

double meanShareWarned(const WarningReport& report, size_t predictor, double lead, double max_false_alarms) {
  assert(max_false_alarms > 0.0);
  if (report.considered(predictor, report.chosen).contacts == 0) return std::numeric_limits<double>::quiet_NaN();
  std::vector<std::pair<double, double>> points;  // false alarms, share
  for (size_t threshold = 0; threshold < report.min_probabilities.size(); ++threshold) {
    const AlarmStatistics& statistics = report.considered(predictor, threshold);
    points.emplace_back(statistics.falseAlarmsPerMinute(), statistics.warnedAhead(lead));
  }
  std::sort(points.begin(), points.end());
  double area = 0.0;
  double share = 0.0;
  double from = 0.0;
  for (const auto& [false_alarms, next_share] : points) {
    if (false_alarms >= max_false_alarms) break;
    area += share * (false_alarms - from);
    from = false_alarms;
    share = std::max(share, next_share);
  }
  return (area + share * (max_false_alarms - from)) / max_false_alarms;
}

std::string tradeoffCsv(const std::vector<WarningReport>& reports) {
  std::string csv = csvLine({"recording", "predictor", "min_probability", "false_alarms_per_min", "warned_0.1",
                             "warned_0.5", "warned_1.0", "chosen"});
  for (const WarningReport& report : reports) {
    for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
      for (size_t threshold = 0; threshold < report.min_probabilities.size(); ++threshold) {
        const AlarmStatistics& statistics = report.considered(predictor, threshold);
        std::vector<std::string> fields = {report.recording, report.predictors[predictor],
                                           csvNumber(report.min_probabilities[threshold]),
                                           csvNumber(statistics.falseAlarmsPerMinute())};
        for (const double lead : kComparedLeads) fields.push_back(csvNumber(statistics.warnedAhead(lead)));
        fields.emplace_back(threshold == report.chosen ? "1" : "0");
        csv += csvLine(fields);
      }
    }
  }
  return csv;
}

std::string tradeoffTable(const WarningReport& report, double max_false_alarms) {
  std::string table = fmt::format(
      "{}, share of contacts warned of, averaged over 0 to {:g} false alarms per min:\n"
      "  predictor         at least   0.1 s  0.5 s  1.0 s ahead\n",
      report.recording, max_false_alarms);
  for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
    table += fmt::format("  {:<26}", report.predictors[predictor]);
    for (const double lead : kComparedLeads) {
      table += fmt::format("  {:.3f}", meanShareWarned(report, predictor, lead, max_false_alarms));
    }
    table += '\n';
  }
  return table;
}

}  // namespace sweep_guard_evaluation
