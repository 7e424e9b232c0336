#include "sweep_guard/guard/outlook.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {
namespace {

auto firstMet(const PredictedObject& object) {
  return std::find_if(object.sweeps.begin(), object.sweeps.end(),
                      [](const PredictedSweep& sweep) { return sweep.met; });
}

}  // namespace

std::vector<std::uint32_t> PredictedObject::triangles() const {
  std::vector<std::uint32_t> all;
  std::merge(reflex.begin(), reflex.end(), considered.begin(), considered.end(), std::back_inserter(all));
  return all;
}

std::optional<Duration> PredictedObject::met() const {
  const auto first = firstMet(*this);
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

void expectedContact(const Outlook& outlook, double min_probability, std::optional<ExpectedContact>& expected) {
  assert(min_probability > 0.0 && min_probability <= 1.0);
  const auto warns = [&](const PredictedSweep& sweep) { return sweep.met || sweep.probability >= min_probability; };
  const PredictedObject* earliest = nullptr;
  std::vector<PredictedSweep>::const_iterator first;
  for (const PredictedObject& object : outlook.objects) {
    const auto sweep = std::find_if(object.sweeps.begin(), object.sweeps.end(), warns);
    if (sweep == object.sweeps.end() || (earliest != nullptr && first->from <= sweep->from)) continue;
    earliest = &object;
    first = sweep;
  }
  if (earliest == nullptr) return expected.reset();
  if (!expected) expected.emplace();
  const auto met = firstMet(*earliest);
  const bool any_met = met != earliest->sweeps.end();
  expected->from = outlook.stamp + first->from;
  expected->met = any_met ? std::optional(outlook.stamp + met->from) : std::nullopt;
  expected->tool_part = (any_met ? met : first)->tool_part;
  expected->probability = 0.0;
  for (auto sweep = first; sweep != earliest->sweeps.end(); ++sweep) {
    expected->probability = std::max(expected->probability, sweep->probability);
  }
  expected->mesh_id = earliest->workpiece->id;
  expected->triangles = earliest->reflex;
  unite(expected->triangles, earliest->considered);
}

std::optional<ExpectedContact> expectedContact(const Outlook& outlook, double min_probability) {
  std::optional<ExpectedContact> expected;
  expectedContact(outlook, min_probability, expected);
  return expected;
}

}  // namespace sweep_guard
