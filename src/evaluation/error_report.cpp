#include "evaluation/error_report.h"

#include <algorithm>
#include <array>
#include <limits>

#include "evaluation/csv.h"
#include "evaluation/format.h"
#include "evaluation/gnuplot.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::toSeconds;

namespace {

constexpr double kPi = 3.14159265358979323846;
const std::string kAxes =
    "set logscale xy\nset xrange [0.02:*] noextend\nset xtics (0.02, 0.05, 0.1, 0.2, 0.5, 1)\nset format y '%g'\n";

using Field = double ErrorSummary::*;

/// What is shown of the errors, in units for a reader.
struct Quantity {
  const char* name;
  const char* unit;
  double scale;
  Field median;
  Field p95;
};

constexpr std::array<Quantity, 2> kQuantities = {{
    {"position", "mm", 1e3, &ErrorSummary::position_median, &ErrorSummary::position_p95},
    {"rotation", "deg", 180.0 / kPi, &ErrorSummary::rotation_median, &ErrorSummary::rotation_p95},
}};

/// The smaller error of `hold` and `constant_velocity`; NaN if one of them is not there.
double simplest(const ErrorReport& report, size_t horizon, Field field) {
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
  const double median_ratio = median / simplest(report, horizon, quantity.median);
  const double p95_ratio = p95 / simplest(report, horizon, quantity.p95);
  const std::string error = format("%.3g/%.3g", quantity.scale * median, quantity.scale * p95);
  return median_ratio > 0.0 ? error + format(" (%.2f/%.2f)", median_ratio, p95_ratio) : error;
}

std::string quantityTable(const ErrorReport& report, const Quantity& quantity) {
  std::string table = format("  %-19s", format("%s [%s]", quantity.name, quantity.unit).c_str());
  for (const sweep_guard_core::Duration horizon : report.horizons) {
    table += format(" %23s", format("%.3g s", toSeconds(horizon)).c_str());
  }
  for (size_t predictor = 0; predictor < report.predictors.size(); ++predictor) {
    table += format("\n    %-17s", report.predictors[predictor].c_str());
    for (size_t horizon = 0; horizon < report.horizons.size(); ++horizon) {
      table += format(" %23s", cell(report, predictor, horizon, quantity).c_str());
    }
  }
  return table + '\n';
}

std::string dataBlock(const ErrorReport& report, size_t predictor, const Quantity& quantity) {
  std::string block;
  for (size_t horizon = 0; horizon < report.horizons.size(); ++horizon) {
    const ErrorSummary& errors = report.errors[predictor][horizon];
    block += format("%.6g %.6g %.6g\n", toSeconds(report.horizons[horizon]), quantity.scale * errors.*quantity.median,
                    quantity.scale * errors.*quantity.p95);
  }
  return block;
}

std::string panel(const ErrorReport& report, const Quantity& quantity) {
  std::string commands;
  std::string curves;
  for (size_t i = 0; i < report.predictors.size(); ++i) {
    commands += format("$curve%zu << END\n", i) + dataBlock(report, i, quantity) + "END\n";
    const std::string colour = colourOf(report.predictors[i]);
    curves += (i == 0 ? "plot " : ", ") + format(
                                              "$curve%zu using 1:3 with lines lw 2 dt 2 lc rgb '%s', "
                                              "$curve%zu using 1:2 with lines lw 3 lc rgb '%s'",
                                              i, colour.c_str(), i, colour.c_str());
  }
  commands += "set title " + gnuplotText(report.recording) + " noenhanced offset 0,-0.6\n";
  return commands + format("set ylabel '%s error [%s]'\n", quantity.name, quantity.unit) + curves;
}

}  // namespace

ErrorReport atHorizons(const ErrorReport& report, const std::vector<sweep_guard_core::Duration>& horizons) {
  ErrorReport some{report.recording, report.predictors, horizons, {}};
  for (const std::vector<ErrorSummary>& of_one : report.errors) {
    some.errors.emplace_back();
    for (const sweep_guard_core::Duration horizon : horizons) {
      const auto found = std::find(report.horizons.begin(), report.horizons.end(), horizon);
      some.errors.back().push_back(of_one[static_cast<size_t>(found - report.horizons.begin())]);
    }
  }
  return some;
}

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
  std::string table = report.recording + format(", %zu samples: errors ahead, median/95th percentile (relative to the ",
                                                report.errors.front().front().samples);
  table += "better of hold and constant_velocity)\n";
  for (const Quantity& quantity : kQuantities) table += quantityTable(report, quantity);
  return table;
}

std::string errorPlot(const std::vector<ErrorReport>& reports, const std::string& path) {
  PlotPage page(path, reports.size(), kQuantities.size());
  page.addKey(reports.front().predictors, {"with lines lw 3 lc rgb 'black' title 'median'",
                                           "with lines lw 2 dt 2 lc rgb 'black' title '95th percentile'"});
  for (size_t row = 0; row < reports.size(); ++row) {
    for (size_t column = 0; column < kQuantities.size(); ++column) {
      const std::string label = row + 1 == reports.size() ? "set xlabel 'horizon [s]'\n" : "";
      page.addPanel(row, column, kAxes + label + panel(reports[row], kQuantities[column]));
    }
  }
  return page.script();
}

}  // namespace sweep_guard_evaluation
