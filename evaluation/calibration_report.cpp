#include "evaluation/calibration_report.h"

#include <fmt/format.h>

#include <utility>

#include "common/csv.h"
#include "guard/contact_probability.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::csvLine;
using sweep_guard_core::csvNumber;
using sweep_guard_core::PredictionInterval;
using sweep_guard_core::toSeconds;

namespace {

constexpr std::pair<Scale, const char*> kScales[] = {
    {Scale::kPlane, "one plane"}, {Scale::kGuard, "the guard"}, {Scale::kOthers, "fitted to the other recordings"}};

std::vector<PredictionOutcome> allBut(const std::vector<std::vector<PredictionOutcome>>& outcomes, size_t recording) {
  std::vector<PredictionOutcome> all;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    if (i != recording) all.insert(all.end(), outcomes[i].begin(), outcomes[i].end());
  }
  return all;
}

std::string figuresRow(const std::string& name, const std::vector<PredictionOutcome>& forecasts) {
  const Calibration figures = calibrationOf(forecasts);
  return fmt::format("    {:<28} {:>8} {:>8.4f} {:>8.4f} {:>8.3f} {:>8.2f}\n", name, figures.count(), figures.error,
                     figures.brier, figures.skill, figures.ratio);
}

std::string figuresTable(const IntervalCalibration& calibration) {
  std::string table;
  for (const auto& [scale, title] : kScales) {
    table +=
        fmt::format("  {:<30} {:>8} {:>8} {:>8} {:>8} {:>8}\n", title, "count", "error", "Brier", "skill", "ratio");
    for (size_t i = 0; i < calibration.recordings.size(); ++i) {
      table += figuresRow(calibration.recordings[i], calibration.forecasts(scale, i));
    }
    table += figuresRow("all", calibration.forecasts(scale));
  }
  return table;
}

std::string binsTable(const IntervalCalibration& calibration) {
  std::string table = "  ten equal bins of all recordings: mean probability, frequency\n";
  for (const auto& [scale, title] : kScales) {
    std::string probabilities;
    std::string frequencies;
    for (const ReliabilityBin& bin : calibrationOf(calibration.forecasts(scale)).bins) {
      probabilities += fmt::format(" {:.3f}", bin.probability);
      frequencies += fmt::format(" {:.3f}", bin.frequency);
    }
    table += fmt::format("    {:<30}{}\n    {:<30}{}\n", title, probabilities, "", frequencies);
  }
  return table;
}

std::string knotsTable(const std::vector<IntervalCalibration>& calibrations) {
  std::string table = "knots fitted to all recordings: deviations";
  std::vector<std::vector<double>> fitted;
  for (const IntervalCalibration& calibration : calibrations) {
    table += fmt::format(", within {:g} s", toSeconds(calibration.length));
    fitted.push_back(fitProbability(allBut(calibration.outcomes, calibration.outcomes.size())));
  }
  for (size_t k = 0; k < kKnots.size(); ++k) {
    table += fmt::format("\n  {{{:g}", kKnots[k]);
    for (const auto& at_knots : fitted) table += fmt::format(", {:.4f}", at_knots[k]);
    table += "},";
  }
  return table + '\n';
}

}  // namespace

std::vector<PredictionOutcome> IntervalCalibration::forecasts(Scale scale, size_t recording) const {
  const auto knots = scale == Scale::kOthers ? fitProbability(allBut(outcomes, recording)) : std::vector<double>();
  const auto probabilityOf = [&](double deviations) {
    if (scale == Scale::kPlane) return sweep_guard_core::contactProbability(deviations);
    if (scale == Scale::kGuard) return sweep_guard_core::probabilityWithin(interval, deviations);
    return probabilityAt(knots, deviations);
  };
  std::vector<PredictionOutcome> forecasts = outcomes[recording];
  for (PredictionOutcome& one : forecasts) one.probability = probabilityOf(one.deviations);
  return forecasts;
}

std::vector<PredictionOutcome> IntervalCalibration::forecasts(Scale scale) const {
  std::vector<PredictionOutcome> all;
  for (size_t i = 0; i < recordings.size(); ++i) {
    const std::vector<PredictionOutcome> some = forecasts(scale, i);
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

std::string calibrationCsv(const std::vector<IntervalCalibration>& calibrations) {
  std::string csv = csvLine({"within_s", "scale", "probability", "frequency"});
  for (const IntervalCalibration& calibration : calibrations) {
    for (const auto& [scale, title] : kScales) {
      for (const ReliabilityBin& bin : calibrationOf(calibration.forecasts(scale)).bins) {
        csv += csvLine(
            {csvNumber(toSeconds(calibration.length)), title, csvNumber(bin.probability), csvNumber(bin.frequency)});
      }
    }
  }
  return csv;
}

}  // namespace sweep_guard_evaluation
