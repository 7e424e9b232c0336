#include "sweep_guard/guard/outlook.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace sweep_guard {
namespace {

std::vector<std::uint32_t> trianglesMet(const PredictedObject& object) {
  std::vector<std::uint32_t> all;
  std::merge(object.reflex.begin(), object.reflex.end(), object.considered.begin(), object.considered.end(),
             std::back_inserter(all));
  return all;
}

}  // namespace

Time Outlook::coveredUntil() const {
  return path.empty() || !unplaced.empty() || !failures.empty() ? stamp : stamp + path.back().ahead;
}

std::optional<ExpectedContact> expectedContact(const Outlook& outlook, double min_probability) {
  assert(min_probability > 0.0 && min_probability <= 1.0);
  std::optional<ExpectedContact> earliest;
  for (const PredictedObject& object : outlook.objects) {
    const auto warns = [&](const PredictedSweep& sweep) { return sweep.met || sweep.probability >= min_probability; };
    const auto first = std::find_if(object.sweeps.begin(), object.sweeps.end(), warns);
    if (first == object.sweeps.end()) continue;
    const Time from = outlook.stamp + first->contact_from;
    if (earliest && earliest->from <= from) continue;
    earliest = ExpectedContact{from, false, 0.0, object.workpiece->id, trianglesMet(object)};
    for (auto sweep = first; sweep != object.sweeps.end(); ++sweep) {
      earliest->met = earliest->met || sweep->met;
      earliest->probability = std::max(earliest->probability, sweep->probability);
    }
  }
  return earliest;
}

}  // namespace sweep_guard
