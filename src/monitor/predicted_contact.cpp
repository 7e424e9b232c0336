#include "sweep_guard/monitor/predicted_contact.h"

#include <algorithm>
#include <cassert>

#include "guard/triangle_set.h"

namespace sweep_guard_core {

void findPredictedContact(const Prediction& prediction, const Timestamps& pose, double min_probability,
                          std::optional<PredictedContact>& contact) {
  assert(min_probability > 0.0 && min_probability <= 1.0);
  const auto warns = [&](const PredictedSweep& sweep) { return sweep.contact || sweep.probability >= min_probability; };
  const PredictedObject* earliest = nullptr;
  std::vector<PredictedSweep>::const_iterator first;
  for (const PredictedObject& object : prediction.objects) {
    const auto sweep = std::find_if(object.sweeps.begin(), object.sweeps.end(), warns);
    if (sweep == object.sweeps.end() || (earliest != nullptr && first->from <= sweep->from)) continue;
    earliest = &object;
    first = sweep;
  }
  if (earliest == nullptr) return contact.reset();
  if (!contact) contact.emplace();
  const auto touching = std::find_if(first, earliest->sweeps.end(), [](const auto& sweep) { return sweep.contact; });
  const bool touches = touching != earliest->sweeps.end();
  contact->earliest = prediction.stamp + first->from;
  contact->contact = touches ? std::optional(prediction.stamp + touching->from) : std::nullopt;
  contact->tool_piece = (touches ? touching : first)->tool_piece;
  contact->probability = 0.0;
  for (auto sweep = first; sweep != earliest->sweeps.end(); ++sweep) {
    contact->probability = std::max(contact->probability, sweep->probability);
  }
  contact->mesh_id = earliest->workpiece->id;
  contact->triangles = earliest->reflex;
  unite(contact->triangles, earliest->considered);
  contact->pose = pose;
  contact->duration = prediction.path.back().ahead;
}

}  // namespace sweep_guard_core
