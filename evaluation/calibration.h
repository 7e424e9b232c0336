#pragma once

#include <array>
#include <vector>

#include "evaluation/guard_findings.h"
#include "evaluation/session_count.h"
#include "guard/contact_probability.h"

namespace sweep_guard_evaluation {

using sweep_guard_core::kMaxDeviations;

/// A prediction about one object for an interval, and what became of it.
struct PredictionOutcome {
  double deviations;  ///< smallest number of the sweeps that begin within the interval, as in PredictedSweep; finite
  bool met;           ///< the tool touched the object within the interval
  double probability = 0.0;  ///< that was forecast from the deviations; set by IntervalCalibration::forecasts()
};

/// Returns the outcomes of the predictions from one pose in every 50 ms, so that a minute counts the same whatever the
/// rate of the poses. Leaves out predictions that carry no information: those while the tool touches the object, those
/// whose interval is not recorded without a gap, and those that are 0.
/// @param findings  along the motion
/// @param object    index in the findings
/// @param touches   of the object: the truth
/// @param interval  length [s] of the interval that begins at the pose
std::vector<PredictionOutcome> outcomesOf(const RecordedMotion& motion, const GuardFindings& findings, size_t object,
                                          const std::vector<TimeInterval>& touches,
                                          sweep_guard_core::Duration interval);

/// Forecasts of similar probability.
struct ReliabilityBin {
  size_t count = 0;
  double probability = 0.0;  ///< mean of the forecasts
  double frequency = 0.0;    ///< share that was met
};

/// The calibration of forecasts of at least kMinForecast. NaN if there are none, or if all or none were met.
struct Calibration {
  std::vector<ReliabilityBin> bins;  ///< kBins of equal size, ascending
  double error = 0.0;                ///< mean difference of probability and frequency, bin by bin
  double brier = 0.0;                ///< mean square of the difference of the probability from 1 (met) or 0
  double skill = 0.0;                ///< 1 - brier / brier of the frequency of all as the only forecast
  double ratio = 0.0;                ///< of the mean probability to the frequency

  size_t count() const;
};

constexpr double kMinForecast = 0.01;
constexpr size_t kBins = 10;

Calibration calibrationOf(std::vector<PredictionOutcome> forecasts);

/// Deviations of the knots of a probability that falls with them: linear between knots, 0 beyond the last one.
constexpr std::array<double, 13> kKnots = {-kMaxDeviations, -2.0, -1.0, -0.5, 0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5,
                                           kMaxDeviations};

/// Fits the probability of being met to outcomes: least squares, which is the smallest Brier score. From knot to knot it falls
/// by at least 0.001.
/// @return at kKnots
std::vector<double> fitProbability(const std::vector<PredictionOutcome>& outcomes);

/// Returns the probability between the knots.
/// @param at_knots  as of fitProbability()
double probabilityAt(const std::vector<double>& at_knots, double deviations);

}  // namespace sweep_guard_evaluation
