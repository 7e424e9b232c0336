#pragma once

#include <memory>

#include "prediction/displacement_regression.h"
#include "prediction/motion_tracker.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// Velocities of a tool, translation [m/s] above rotation [rad/s], or of a joint: one in each column.
template <typename Space, int N = kRegressors>
using Regressors = Eigen::Matrix<double, Space::kSize, N>;

template <typename Space>
struct LearnedMotion;

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

  /// Returns the velocities at the newest sample that the displacement is regressed on; null: there are none.
  virtual const Regressors<Space>* regressors() const { return nullptr; }
};

/// Makes the extrapolator that `options.predictor` names.
/// @param learned  of `direct`, not null; not checked
/// @throws InvalidInput if the name is unknown
template <typename Space>
std::unique_ptr<Extrapolator<Space>> makeExtrapolator(const PredictorOptions& options,
                                                      const std::shared_ptr<LearnedMotion<Space>>& learned);

}  // namespace sweep_guard_core
