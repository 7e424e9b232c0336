#pragma once

#include <functional>
#include <vector>

#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// How many sweeps a predicted path is cut into, and when the time for them is over.
struct SweepPlan {
  std::vector<size_t> sweep_ends;       ///< pose numbers from sweepEnds(); empty: every pose ends a sweep
  std::function<bool()> out_of_time{};  ///< true once the time after the reflex interval is used up; empty: never

  size_t sweepCount(const PredictedPath& path) const { return sweep_ends.empty() ? path.size() : sweep_ends.size(); }
};

}  // namespace sweep_guard_core
