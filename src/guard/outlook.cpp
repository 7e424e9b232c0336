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

std::optional<ExpectedContact> expectedContact(const Outlook& outlook, double min_probability) {
  assert(min_probability > 0.0 && min_probability <= 1.0);
  std::optional<ExpectedContact> earliest;
  for (const PredictedObject& object : outlook.objects) {
    const auto warns = [&](const PredictedSweep& sweep) { return sweep.met || sweep.probability >= min_probability; };
    const auto first = std::find_if(object.sweeps.begin(), object.sweeps.end(), warns);
    if (first == object.sweeps.end()) continue;
    const Time from = outlook.stamp + first->from;
    if (earliest && earliest->from <= from) continue;
    earliest = ExpectedContact{from, false, 0.0, object.workpiece->id, object.triangles()};
    for (auto sweep = first; sweep != object.sweeps.end(); ++sweep) {
      earliest->met = earliest->met || sweep->met;
      earliest->probability = std::max(earliest->probability, sweep->probability);
    }
  }
  return earliest;
}

}  // namespace sweep_guard
