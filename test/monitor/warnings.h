#pragma once

#include <optional>

#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_core {

inline Warning warningOf(const WarningMonitor& monitor, const Instant& now) {
  Warning warning;
  monitor.warning(now, warning);
  return warning;
}

inline Warning warningOf(const WarningInputs& inputs, const Instant& now, const WarningLimits& limits) {
  Warning warning;
  computeWarning(inputs, now, limits, warning);
  return warning;
}

// With the first workpiece that is met, both levels at the same deviations; without them, only by the path itself.
inline std::optional<PredictedContact> predictedContact(const Prediction& prediction,
                                                        std::optional<double> deviations = {}) {
  const auto threshold = [&](PredictionInterval interval) {
    return deviations ? probabilityWithin(interval, *deviations) : 1.0;
  };
  const Duration end = prediction.path.empty() ? Duration(0) : prediction.path.back().ahead;
  const ContactThresholds thresholds = {threshold(PredictionInterval::kReflex),
                                        threshold(PredictionInterval::kConsidered), end, end};
  std::optional<PredictedContact> earliest;
  std::optional<PredictedContact> contact;
  for (const PredictedObject& object : prediction.objects) {
    findPredictedContact(prediction, object, {prediction.stamp, {}}, thresholds, contact);
    if (contact && (!earliest || contact->earliest() < earliest->earliest())) earliest = contact;
  }
  return earliest;
}

}  // namespace sweep_guard_core
