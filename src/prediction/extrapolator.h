#pragma once

#include <memory>

#include "prediction/motion_tracker.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Extrapolates the motion of a tool or a joint.
template <typename Space>
class Extrapolator {
 public:
  virtual ~Extrapolator() = default;

  /// Adds the newest sample of the tracker.
  virtual void observe(const MotionTracker<Space>& tracker) = 0;

  /// Predicts the displacement after the newest sample.
  /// @param ahead  [s], > 0
  virtual typename Space::Vector displacementIn(double ahead) const = 0;
};

template <typename Space>
struct LearnedMotion;

/// Makes the extrapolator that `options.predictor` names.
/// @param learned  that `direct` shares with others; null: it learns alone
/// @throws InvalidInput if the name is unknown
template <typename Space>
std::unique_ptr<Extrapolator<Space>> makeExtrapolator(const PredictorOptions& options, const Space& space,
                                                      std::shared_ptr<LearnedMotion<Space>> learned = nullptr);

}  // namespace sweep_guard_core
