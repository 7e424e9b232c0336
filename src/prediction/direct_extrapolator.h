#pragma once

#include <array>

#include "prediction/delayed_targets.h"
#include "prediction/displacement_regression.h"
#include "prediction/extrapolator.h"
#include "prediction/motion_regressors.h"

namespace sweep_guard_core {

/// Learns the operator's displacements from the recent motion: for each of kLearnedHorizons, a regression of the
/// displacement on MotionRegressors. Each one expects what was learned for the next shorter horizon.
template <typename Space>
class DirectExtrapolator : public Extrapolator<Space> {
 public:
  using Vector = typename Space::Vector;

  /// @param profile  what it begins with; null: nothing
  DirectExtrapolator(const typename Space::Speeds& prior_speeds, const Profile* profile);

  bool save(Profile& profile) const override;
  void observe(const MotionTracker<Space>& tracker) override;
  Vector displacementIn(double ahead) const override;

 private:
  using Regression = DisplacementRegression<Space::kAxes>;
  using Weights = typename Regression::Weights;
  using Regressions = std::array<Regression, kLearnedHorizons.size()>;

  void begin(const Profile& profile);
  static Weights expectedWeights(const Regressions& regressions, size_t horizon);

  MotionRegressors<Space> regressors_;
  DelayedTargets<Space, typename MotionRegressors<Space>::Values> targets_;
  std::array<Regressions, Space::kGroups> groups_;
};

}  // namespace sweep_guard_core
