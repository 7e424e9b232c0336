#include "sweep_guard/monitor/predicted_contact.h"

#include <algorithm>
#include <cassert>

#include "guard/triangle_set.h"

namespace sweep_guard_core {

Time PredictedContact::earliest() const {
  if (!reflex || !considered) return reflex ? *reflex : considered.value();
  return std::min(*reflex, *considered);
}

void findPredictedContact(const Prediction& prediction, const PredictedObject& object, const Timestamps& pose,
                          const ContactThresholds& thresholds, std::optional<PredictedContact>& contact) {
  assert(thresholds.reflex > 0.0 && thresholds.considered > 0.0);
  const auto begin = object.sweeps.begin();
  const auto end = object.sweeps.end();
  const auto firstFrom = [&](PredictionInterval interval, double probability) {
    const double deviations = deviationsAt(interval, probability);
    return std::find_if(begin, end,
                        [=](const PredictedSweep& sweep) { return sweep.contact || sweep.deviations <= deviations; });
  };
  const auto startOf = [&](auto sweep) {
    return sweep == end ? std::nullopt : std::optional(prediction.stamp + sweep->from);
  };
  const auto probabilityUpTo = [&](PredictionInterval interval, Duration interval_end, auto first) {
    const Duration after_first = first == end ? interval_end : first->from + Duration(1);
    return object.probability(interval, std::max(interval_end, after_first));
  };
  const auto reflex = firstFrom(PredictionInterval::kReflex, thresholds.reflex);
  const auto considered = firstFrom(PredictionInterval::kConsidered, thresholds.considered);
  const auto first = std::min(reflex, considered);
  if (first == end) return contact.reset();
  if (!contact) contact.emplace();
  const auto touching = std::find_if(first, end, [](const PredictedSweep& sweep) { return sweep.contact; });
  contact->reflex = startOf(reflex);
  contact->considered = startOf(considered);
  contact->contact = startOf(touching);
  contact->tool_piece = (touching != end ? touching : first)->tool_piece;
  contact->reflex_probability = probabilityUpTo(PredictionInterval::kReflex, thresholds.reflex_end, reflex);
  contact->considered_probability =
      probabilityUpTo(PredictionInterval::kConsidered, thresholds.considered_end, considered);
  contact->mesh_id = object.workpiece->id;
  contact->triangles = object.reflex;
  unite(contact->triangles, object.considered);
  contact->pose = pose;
  contact->duration = prediction.path.back().ahead;
}

}  // namespace sweep_guard_core
