#pragma once

#include <limits>
#include <string>
#include <vector>

#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

inline const std::vector<Duration> kAhead = {std::chrono::milliseconds(10),  std::chrono::milliseconds(50),
                                             std::chrono::milliseconds(100), std::chrono::milliseconds(200),
                                             std::chrono::milliseconds(500), std::chrono::milliseconds(1000)};

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();  ///< limit of a joint

/// Returns the time so long after the first 1000 s.
inline Time at(double seconds) { return Time(fromSeconds(1000.0 + seconds)); }

inline PredictorOptions optionsOf(const std::string& name) {
  PredictorOptions options;
  options.predictor = name;
  return options;
}

}  // namespace sweep_guard_core
