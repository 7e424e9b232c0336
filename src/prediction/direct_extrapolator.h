#pragma once

#include <array>
#include <memory>
#include <utility>

#include "prediction/delayed_targets.h"
#include "prediction/displacement_regression.h"
#include "prediction/extrapolator.h"
#include "prediction/motion_regressors.h"

namespace sweep_guard_core {

/// What is learned for each of kLearnedHorizons, of each group of axes. Channels may share it: joints that one hand moves.
template <typename Space>
struct LearnedMotion {
  using Regressions = std::array<DisplacementRegression<Space::kAxes>, kLearnedHorizons.size()>;

  /// @param channels  number of those that share it, > 0
  LearnedMotion(const typename Space::Speeds& prior_speeds, size_t channels);

  std::array<Regressions, Space::kGroups> groups;
  const double share;  ///< of each channel: it counts as so much of the time
};

/// Learns the operator's displacements from the recent motion: for each of kLearnedHorizons, a regression of the
/// displacement on MotionRegressors. Each one expects what was learned for the next shorter horizon.
template <typename Space>
class DirectExtrapolator : public Extrapolator<Space> {
 public:
  using Vector = typename Space::Vector;

  /// @param learned  not null; not checked
  explicit DirectExtrapolator(std::shared_ptr<LearnedMotion<Space>> learned) : learned_(std::move(learned)) {}

  void observe(const MotionTracker<Space>& tracker) override;
  Vector displacementIn(double ahead) const override;

 private:
  using Regression = DisplacementRegression<Space::kAxes>;
  using Weights = typename Regression::Weights;
  using Regressions = typename LearnedMotion<Space>::Regressions;

  static Weights expectedWeights(const Regressions& regressions, size_t horizon);

  MotionRegressors<Space> regressors_;
  DelayedTargets<Space, typename MotionRegressors<Space>::Values> targets_;
  const std::shared_ptr<LearnedMotion<Space>> learned_;
};

}  // namespace sweep_guard_core
