#include "evaluation/calibration_report.h"

#include <fmt/format.h>

#include "guard/contact_probability.h"
#include "recording/gnuplot.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::PredictionInterval;
using sweep_guard_core::toSeconds;
using sweep_guard_recording::PlotPage;

namespace {

struct ScaleStyle {
  Scale scale;
  const char* title;
  const char* color;
};

constexpr ScaleStyle kScales[] = {{Scale::kPlane, "one plane", "#999999"},
                                  {Scale::kGuard, "the guard", "#0072B2"},
                                  {Scale::kOthers, "fitted to the other recordings", "#D55E00"}};

std::vector<PredictionOutcome> allBut(const std::vector<std::vector<PredictionOutcome>>& outcomes, size_t recording) {
  std::vector<PredictionOutcome> all;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    if (i != recording) all.insert(all.end(), outcomes[i].begin(), outcomes[i].end());
  }
  return all;
}

std::string figuresRow(const std::string& name, const std::vector<Forecast>& forecasts) {
  const Calibration figures = calibrationOf(forecasts);
  return fmt::format("    {:<28} {:>8} {:>8.4f} {:>8.4f} {:>8.3f} {:>8.2f}\n", name, figures.count(), figures.error,
                     figures.brier, figures.skill, figures.ratio);
}

std::string figuresTable(const IntervalCalibration& calibration) {
  std::string table;
  for (const ScaleStyle& style : kScales) {
    table += fmt::format("  {:<30} {:>8} {:>8} {:>8} {:>8} {:>8}\n", style.title, "count", "error", "Brier", "skill",
                         "ratio");
    for (size_t i = 0; i < calibration.recordings.size(); ++i) {
      table += figuresRow(calibration.recordings[i], calibration.forecasts(style.scale, i));
    }
    table += figuresRow("all", calibration.forecasts(style.scale));
  }
  return table;
}

std::string binsTable(const IntervalCalibration& calibration) {
  std::string table = "  ten equal bins of all recordings: mean probability, frequency\n";
  for (const ScaleStyle& style : kScales) {
    std::string probabilities;
    std::string frequencies;
    for (const ReliabilityBin& bin : calibrationOf(calibration.forecasts(style.scale)).bins) {
      probabilities += fmt::format(" {:.3f}", bin.probability);
      frequencies += fmt::format(" {:.3f}", bin.frequency);
    }
    table += fmt::format("    {:<30}{}\n    {:<30}{}\n", style.title, probabilities, "", frequencies);
  }
  return table;
}

std::string knotsTable(const std::vector<IntervalCalibration>& calibrations) {
  std::string table = "knots fitted to all recordings: deviations";
  std::vector<std::vector<ProbabilityKnot>> fitted;
  for (const IntervalCalibration& calibration : calibrations) {
    table += fmt::format(", within {:g} s", toSeconds(calibration.length));
    fitted.push_back(fitProbability(allBut(calibration.outcomes, calibration.outcomes.size())));
  }
  for (size_t k = 0; k < fitted.front().size(); ++k) {
    table += fmt::format("\n  {{{:g}", fitted.front()[k].deviations);
    for (const auto& knots : fitted) table += fmt::format(", {:.4f}", knots[k].probability);
    table += "},";
  }
  return table + '\n';
}

std::string panel(const IntervalCalibration& calibration) {
  std::string data;
  std::string plot = "plot x with lines dt 2 lc rgb 'black'";
  for (const ScaleStyle& style : kScales) {
    const auto number = static_cast<int>(style.scale);
    data += fmt::format("$scale{} << END\n", number);
    for (const ReliabilityBin& bin : calibrationOf(calibration.forecasts(style.scale)).bins) {
      data += fmt::format("{:.6g} {:.6g}\n", bin.probability, bin.frequency);
    }
    data += "END\n";
    plot += fmt::format(", $scale{} with linespoints lw 2 pt 7 lc rgb '{}'", number, style.color);
  }
  return fmt::format(
      "{}set title 'within {:g} s' offset 0,-0.6\nset xrange [0:1]\nset yrange [0:1]\nset xlabel 'probability'\n"
      "set ylabel 'how often it came'\n{}",
      data, toSeconds(calibration.length), plot);
}

}  // namespace

std::vector<Forecast> IntervalCalibration::forecasts(Scale scale, size_t recording) const {
  const auto knots =
      scale == Scale::kOthers ? fitProbability(allBut(outcomes, recording)) : std::vector<ProbabilityKnot>();
  const auto probabilityOf = [&](double deviations) {
    if (scale == Scale::kPlane) return sweep_guard_core::contactProbability(deviations);
    if (scale == Scale::kGuard) return sweep_guard_core::probabilityWithin(interval, deviations);
    return probabilityAt(knots, deviations);
  };
  std::vector<Forecast> forecasts;
  for (const PredictionOutcome& one : outcomes[recording]) {
    forecasts.push_back({probabilityOf(one.deviations), one.met});
  }
  return forecasts;
}

std::vector<Forecast> IntervalCalibration::forecasts(Scale scale) const {
  std::vector<Forecast> all;
  for (size_t i = 0; i < recordings.size(); ++i) {
    const std::vector<Forecast> some = forecasts(scale, i);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<IntervalCalibration> calibrate(const std::vector<Sessions>& sessions,
                                           const sweep_guard_core::WarningLimits& limits) {
  std::vector<IntervalCalibration> calibrations = {{PredictionInterval::kReflex, limits.reflex, {}, {}},
                                                   {PredictionInterval::kConsidered, limits.considered, {}, {}}};
  for (IntervalCalibration& calibration : calibrations) {
    for (const Sessions& one : sessions) {
      calibration.recordings.push_back(one.recording());
      calibration.outcomes.push_back(one.outcomes(calibration.length));
    }
  }
  return calibrations;
}

std::string calibrationTable(const std::vector<IntervalCalibration>& calibrations) {
  std::string table;
  for (const IntervalCalibration& calibration : calibrations) {
    table += fmt::format("probability of a contact within {:g} s\n", toSeconds(calibration.length));
    table += figuresTable(calibration) + binsTable(calibration) + '\n';
  }
  return table + knotsTable(calibrations);
}

std::string calibrationPlot(const std::vector<IntervalCalibration>& calibrations, const std::string& path) {
  std::vector<std::string> entries;
  for (const ScaleStyle& style : kScales) {
    entries.push_back(fmt::format("with lines lw 4 lc rgb '{}' title '{}'", style.color, style.title));
  }
  PlotPage page(path, 1, calibrations.size());
  page.addKey({}, entries);
  for (size_t i = 0; i < calibrations.size(); ++i) page.addPanel(0, i, panel(calibrations[i]));
  return page.script();
}

}  // namespace sweep_guard_evaluation
