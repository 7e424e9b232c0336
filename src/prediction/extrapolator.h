#pragma once

#include <memory>
#include <vector>

#include "prediction/displacement.h"
#include "prediction/pose_tracker.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Extrapolates the motion of a tool.
class Extrapolator {
 public:
  virtual ~Extrapolator() = default;

  /// Adds the newest pose of the tracker.
  virtual void observe(const PoseTracker& tracker) = 0;

  /// Predicts the displacement of the tool after the newest pose.
  /// @param ahead  [s], > 0
  virtual Vector6d displacementIn(double ahead) const = 0;

  /// Writes what was learned of the operator. Returns false if this extrapolator learns nothing.
  virtual bool save(Profile& /*profile*/) const { return false; }
};

/// Makes the extrapolator that `options.predictor` names; `direct` begins with the profile.
/// @throws InvalidInput if the name is unknown
std::unique_ptr<Extrapolator> makeExtrapolator(const PredictorOptions& options);

}  // namespace sweep_guard_core
