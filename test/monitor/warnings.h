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

inline std::optional<PredictedContact> predictedContact(const Prediction& prediction, double min_probability) {
  std::optional<PredictedContact> contact;
  findPredictedContact(prediction, {prediction.stamp, {}}, min_probability, contact);
  return contact;
}

}  // namespace sweep_guard_core
