#include "evaluation/error_report.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/csv.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::toSeconds;

namespace {

using Field = double ErrorSummary::*;

/// A row of the report, in units for a reader.
struct Quantity {
  const char* name;
  const char* unit;
  double scale;
  Field median;
  Field p95;
};

constexpr std::array<Quantity, 2> kQuantities = {{
    {"position", "mm", 1e3, &ErrorSummary::position_median, &ErrorSummary::position_p95},
    {"rotation", "deg", 180.0 / M_PI, &ErrorSummary::rotation_median, &ErrorSummary::rotation_p95},
}};

/// Returns the smaller error of `hold` and `constant_velocity`; NaN if one of them is missing.
double bestBaseline(const ErrorReport& report, size_t horizon, Field field) {
  double least = std::numeric_limits<double>::infinity();
  for (const char* const name : {"hold", "constant_velocity"}) {
    const auto found = std::find(report.predictors.begin(), report.predictors.end(), name);
    if (found == report.predictors.end()) return std::numeric_limits<double>::quiet_NaN();
    const auto predictor = static_cast<size_t>(found - report.predictors.begin());
    least = std::min(least, report.errors[predictor][horizon].*field);
  }
  return least;
}

std::string cell(const ErrorReport& report, size_t predictor, size_t horizon, const Quantity& quantity) {
  const ErrorSummary& errors = report.errors[predictor][horizon];
  const double median = errors.*quantity.median;
  const double p95 = errors.*quantity.p95;
  const double median_ratio = median / bestBaseline(report, horizon, quantity.median);
  const double p95_ratio = p95 / bestBaseline(report, horizon, quantity.p95);
  const std::string error = fmt::format("{:.3g}/{:.3g}", quantity.scale * median, quantity.scale * p95);
  return median_ratio > 0.0 ? error + fmt::format(" ({:.2f}/{:.2f})", median_ratio, p95_ratio) : error;
}

std::string quantityTable(const ErrorReport& report, const Quantity& quantity) {
  std::string table = fmt::format("  {:<19}", fmt::format("{} [{}]", quantity.name, quantity.unit));
  for (const sweep_guard_core::Duration horizon : report.horizons) {
    table += fmt::format(" {:>23}", fmt::format("{:.3g} s", toSeconds(horizon)));
  }
  for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
    table += fmt::format("\n    {:<17}", report.predictors[predictor]);
    for (size_t horizon = 0; horizon < report.horizons.size(); ++horizon) {
      table += fmt::format(" {:>23}", cell(report, predictor, horizon, quantity));
    }
  }
  return table + '\n';
}

}  // namespace

std::string errorCsv(const std::vector<ErrorReport>& reports) {
  std::string csv = csvLine({"recording", "predictor", "horizon_s", "position_median_m", "position_p95_m",
                             "rotation_median_rad", "rotation_p95_rad", "samples"});
  for (const ErrorReport& report : reports) {
    for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
      for (size_t horizon = 0; horizon < report.horizons.size(); ++horizon) {
        const ErrorSummary& errors = report.errors[predictor][horizon];
        csv += csvLine({report.recording, report.predictors[predictor], csvNumber(toSeconds(report.horizons[horizon])),
                        csvNumber(errors.position_median), csvNumber(errors.position_p95),
                        csvNumber(errors.rotation_median), csvNumber(errors.rotation_p95),
                        std::to_string(errors.samples)});
      }
    }
  }
  return csv;
}

std::string errorTable(const ErrorReport& report) {
  std::string table = fmt::format(
      "{}, {} samples: prediction error, median/95th percentile (relative to the better of hold and "
      "constant_velocity)\n",
      report.recording, report.errors.front().front().samples);
  for (const Quantity& quantity : kQuantities) table += quantityTable(report, quantity);
  return table;
}

}  // namespace sweep_guard_evaluation
