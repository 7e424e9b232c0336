#include "evaluation/session_tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/csv.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::WarningThresholds;

namespace {

const std::vector<double> kConsideredOn = {0.002, 0.005, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08,
                                           0.1,   0.12,  0.14, 0.17, 0.2,  0.25, 0.3,  0.35, 0.5,  1.0};

std::string shareText(double value) { return std::isnan(value) ? "-" : fmt::format("{:.3f}", value); }

std::string yaml(const WarningThresholds& thresholds) {
  return fmt::format("warning:\n  considered_on: {:g}\n  considered_off: {:g}\n  reflex_probability: {:g}\n",
                     thresholds.considered_on, thresholds.considered_off, thresholds.reflex);
}

}  // namespace

std::vector<WarningThresholds> tuningThresholds(const WarningThresholds& current) {
  std::vector<WarningThresholds> thresholds;
  thresholds.reserve(std::size(kConsideredOn));
  for (const double on : kConsideredOn) {
    thresholds.push_back({current.reflex, on, std::min(current.considered_off, on)});
  }
  return thresholds;
}

std::optional<TuningPoint> choosePoint(const std::vector<TuningPoint>& points, double unjustified_per_min) {
  std::optional<TuningPoint> chosen;
  for (auto point = points.rbegin(); point != points.rend(); ++point) {
    const bool few = point->figures.unjustifiedPerMinute() <= unjustified_per_min;
    if (chosen && !few) break;
    if (few) chosen = *point;
  }
  return chosen;
}

std::string tuningCsv(const std::vector<TuningPoint>& points, double unjustified_per_min) {
  std::string csv =
      csvLine({"considered_on", "considered_off", "reflex_probability", "unjustified_per_min", "precision",
               "warned_0.1", "warned_0.3", "warned_0.5", "warned_1.0", "late", "false_on_share", "at_most_per_min"});
  for (const auto& [thresholds, figures] : points) {
    std::vector<std::string> fields;
    for (const double value : {thresholds.considered_on, thresholds.considered_off, thresholds.reflex,
                               figures.unjustifiedPerMinute(), figures.precision()}) {
      fields.push_back(csvNumber(value));
    }
    for (size_t lead = 0; lead < kSessionLeads.size(); ++lead) fields.push_back(csvNumber(figures.warnedShare(lead)));
    fields.push_back(std::to_string(figures.late));
    fields.push_back(csvNumber(figures.falseOnShare()));
    fields.push_back(csvNumber(unjustified_per_min));
    csv += csvLine(fields);
  }
  return csv;
}

std::string tuningText(const std::vector<TuningPoint>& points, double unjustified_per_min) {
  std::string text = "  considered_on  off     unjustified/min  precision  warned 0.5 s  1.0 s ahead  without REFLEX\n";
  for (const auto& [thresholds, figures] : points) {
    text += fmt::format("  {:<13g}  {:<7g} {:>14.2f}  {:>9}  {:>12}  {:>11}  {:>14}\n", thresholds.considered_on,
                        thresholds.considered_off, figures.unjustifiedPerMinute(), shareText(figures.precision()),
                        shareText(figures.warnedShare(2)), shareText(figures.warnedShare(3)), figures.late);
  }
  const std::optional<TuningPoint> chosen = choosePoint(points, unjustified_per_min);
  if (chosen)
    return text + fmt::format("\n# at most {:g} unjustified alarms per minute\n", unjustified_per_min) +
           yaml(chosen->thresholds);
  const auto fewer = [](const TuningPoint& a, const TuningPoint& b) {
    return a.figures.unjustifiedPerMinute() < b.figures.unjustifiedPerMinute();
  };
  const double fewest = std::min_element(points.begin(), points.end(), fewer)->figures.unjustifiedPerMinute();
  return text + fmt::format("\nno threshold has at most {:g} unjustified alarms per minute; the fewest are {:.2f}\n",
                            unjustified_per_min, fewest);
}

}  // namespace sweep_guard_evaluation
