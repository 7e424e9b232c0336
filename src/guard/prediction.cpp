#include "sweep_guard/guard/prediction.h"

#include <algorithm>
#include <iterator>

namespace sweep_guard_core {

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
