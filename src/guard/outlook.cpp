#include "sweep_guard/guard/outlook.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace sweep_guard {

std::vector<std::uint32_t> PredictedObject::triangles() const {
  std::vector<std::uint32_t> all;
  std::merge(reflex.begin(), reflex.end(), considered.begin(), considered.end(), std::back_inserter(all));
  return all;
}

std::optional<Duration> PredictedObject::met() const {
  const auto first = std::find_if(sweeps.begin(), sweeps.end(), [](const PredictedSweep& sweep) { return sweep.met; });
  return first == sweeps.end() ? std::nullopt : std::optional(first->from);
}

void PredictedObject::clear() {
  workpiece.reset();
  sweeps.clear();
  reflex.clear();
  considered.clear();
  volumes_M.clear();
  volumes_tested = 0;
}

Time Outlook::coveredUntil() const {
  return path.empty() || !unplaced.empty() || !failures.empty() ? stamp : stamp + path.back().ahead;
}

bool Outlook::complete() const { return !path.empty() && !objects.empty() && unplaced.empty() && failures.empty(); }

double Outlook::probability() const {
  double largest = 0.0;
  for (const PredictedObject& object : objects) {
    for (const PredictedSweep& sweep : object.sweeps) largest = std::max(largest, sweep.probability);
  }
  return largest;
}

std::optional<Duration> Outlook::met() const {
  std::optional<Duration> first;
  for (const PredictedObject& object : objects) {
    const std::optional<Duration> met = object.met();
    if (met && (!first || *met < *first)) first = met;
  }
  return first;
}

std::optional<ExpectedContact> expectedContact(const Outlook& outlook, double min_probability) {
  assert(min_probability > 0.0 && min_probability <= 1.0);
  std::optional<ExpectedContact> earliest;
  for (const PredictedObject& object : outlook.objects) {
    const auto warns = [&](const PredictedSweep& sweep) { return sweep.met || sweep.probability >= min_probability; };
    const auto first = std::find_if(object.sweeps.begin(), object.sweeps.end(), warns);
    if (first == object.sweeps.end()) continue;
    const Time from = outlook.stamp + first->from;
    if (earliest && earliest->from <= from) continue;
    earliest = ExpectedContact{from, std::nullopt, 0.0, object.workpiece->id, object.triangles()};
    if (const auto met = object.met()) earliest->met = outlook.stamp + *met;
    for (auto sweep = first; sweep != object.sweeps.end(); ++sweep) {
      earliest->probability = std::max(earliest->probability, sweep->probability);
    }
  }
  return earliest;
}

}  // namespace sweep_guard
