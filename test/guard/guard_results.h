#pragma once

#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {

inline SweepReport reportOf(Guard& guard, const PoseWithFrames& pose, const Workpieces& workpieces) {
  SweepReport report;
  guard.sweep(pose, workpieces, report);
  return report;
}

inline Prediction predictionOf(Guard& guard, Duration age, const Workpieces& workpieces) {
  Prediction prediction;
  guard.predict(age, workpieces, prediction);
  return prediction;
}

}  // namespace sweep_guard_core
