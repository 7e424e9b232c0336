#include "sweep_guard/guard/prediction.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "guard/contact_probability.h"

namespace sweep_guard_core {
namespace {

struct CalibrationKnot {
  double deviations;
  double reflex;
  double considered;
};

// Printed by evaluate_prediction --calibration.
constexpr std::array<CalibrationKnot, 13> kKnots = {{{-kMaxDeviations, 0.9167, 0.9046},
                                                     {-2.0, 0.8843, 0.7906},
                                                     {-1.0, 0.8833, 0.6533},
                                                     {-0.5, 0.8823, 0.4723},
                                                     {0.0, 0.2009, 0.3411},
                                                     {0.25, 0.1148, 0.1734},
                                                     {0.5, 0.0339, 0.0772},
                                                     {0.75, 0.0115, 0.0384},
                                                     {1.0, 0.0105, 0.0213},
                                                     {1.5, 0.0068, 0.0060},
                                                     {2.0, 0.0058, 0.0030},
                                                     {2.5, 0.0020, 0.0020},
                                                     {kMaxDeviations, 0.0010, 0.0010}}};

double valueOf(const CalibrationKnot& knot, PredictionInterval interval) {
  return interval == PredictionInterval::kReflex ? knot.reflex : knot.considered;
}

// Bisects a function that falls.
template <typename Function>
double largestWith(double probability, const Function& probability_at) {
  double lower = -kMaxDeviations;
  double upper = kMaxDeviations;
  if (probability_at(upper) >= probability) return upper;
  if (probability_at(lower) < probability) return -std::numeric_limits<double>::infinity();
  for (double middle = 0.0; middle != lower && middle != upper; middle = 0.5 * (lower + upper)) {
    (probability_at(middle) >= probability ? lower : upper) = middle;
  }
  return lower;
}

}  // namespace

const char* textOf(PredictionSource source) {
  switch (source) {
    case PredictionSource::kCommand:
      return "command";
    case PredictionSource::kTrajectory:
      return "trajectory";
    default:
      return "measured";
  }
}

double probabilityWithin(PredictionInterval interval, double deviations) {
  if (deviations > kMaxDeviations) return 0.0;
  const auto after = [=](const CalibrationKnot& knot) { return knot.deviations > deviations; };
  const auto next = std::find_if(kKnots.begin(), kKnots.end(), after);
  if (next == kKnots.begin()) return valueOf(kKnots.front(), interval);
  if (next == kKnots.end()) return valueOf(kKnots.back(), interval);
  const CalibrationKnot& before = *std::prev(next);
  const double share = (deviations - before.deviations) / (next->deviations - before.deviations);
  return (1.0 - share) * valueOf(before, interval) + share * valueOf(*next, interval);
}

double deviationsAt(PredictionInterval interval, double probability) {
  return largestWith(probability, [=](double deviations) { return probabilityWithin(interval, deviations); });
}

double fromPlaneProbability(PredictionInterval interval, double plane_probability) {
  const double deviations = largestWith(plane_probability, contactProbability);
  return deviations < -kMaxDeviations ? 1.0 : probabilityWithin(interval, deviations);
}

std::vector<std::uint32_t> PredictedObject::triangles() const {
  std::vector<std::uint32_t> all;
  std::merge(reflex.begin(), reflex.end(), considered.begin(), considered.end(), std::back_inserter(all));
  return all;
}

std::optional<Duration> PredictedObject::firstContact() const {
  const auto first = std::find_if(sweeps.begin(), sweeps.end(), [](const auto& sweep) { return sweep.contact; });
  return first == sweeps.end() ? std::nullopt : std::optional(first->from);
}

double PredictedObject::probability(PredictionInterval interval, Duration end) const {
  double deviations = std::numeric_limits<double>::infinity();
  for (const PredictedSweep& sweep : sweeps) {
    if (sweep.from < end) deviations = std::min(deviations, sweep.deviations);
  }
  return probabilityWithin(interval, deviations);
}

void PredictedObject::clear() {
  workpiece.reset();
  sweeps.clear();
  reflex.clear();
  considered.clear();
  volumes_M.clear();
  volumes_tested = 0;
}

Time Prediction::coveredUntil() const {
  return path.empty() || !unplaced.empty() || !failures.empty() ? stamp : stamp + path.back().ahead;
}

bool Prediction::complete() const { return !path.empty() && !objects.empty() && unplaced.empty() && failures.empty(); }

double Prediction::probability(PredictionInterval interval, Duration end) const {
  double largest = 0.0;
  for (const PredictedObject& object : objects) largest = std::max(largest, object.probability(interval, end));
  return largest;
}

std::optional<Duration> Prediction::firstContact() const {
  std::optional<Duration> first;
  for (const PredictedObject& object : objects) {
    const std::optional<Duration> contact = object.firstContact();
    if (contact && (!first || *contact < *first)) first = contact;
  }
  return first;
}

}  // namespace sweep_guard_core
