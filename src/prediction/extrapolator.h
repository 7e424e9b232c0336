#pragma once

#include <memory>
#include <vector>

#include "prediction/displacement.h"
#include "prediction/pose_tracker.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// One way of carrying a motion on.
class Extrapolator {
 public:
  virtual ~Extrapolator() = default;

  /// Takes in the newest pose of the tracker.
  virtual void observe(const PoseTracker& tracker) = 0;

  /// How far the tool is expected to go from the newest pose.
  /// @param ahead  [s], > 0
  virtual Vector6d displacementIn(double ahead) const = 0;

 protected:
  Extrapolator() = default;
  Extrapolator(const Extrapolator&) = default;
  Extrapolator& operator=(const Extrapolator&) = default;
};

/// @throws InvalidInput if there is no predictor of that name
std::unique_ptr<Extrapolator> makeExtrapolator(const PredictorOptions& options);

}  // namespace sweep_guard_core
