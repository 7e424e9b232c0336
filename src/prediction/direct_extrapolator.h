#pragma once

#include <array>

#include "prediction/delayed_targets.h"
#include "prediction/displacement_regression.h"
#include "prediction/extrapolator.h"
#include "prediction/motion_regressors.h"

namespace sweep_guard_core {

/// Learns the operator's displacements from the recent motion: for each of kLearnedHorizons, a regression of the
/// displacement on MotionRegressors. Each one expects what was learned for the next shorter horizon.
class DirectExtrapolator : public Extrapolator {
 public:
  /// @param profile  what it begins with; null: nothing
  explicit DirectExtrapolator(const Profile* profile);

  bool save(Profile& profile) const override;
  void observe(const PoseTracker& tracker) override;
  Vector6d displacementIn(double ahead) const override;

 private:
  using Regressions = std::array<DisplacementRegression, kLearnedHorizons.size()>;

  static DisplacementRegression::Weights expectedWeights(const Regressions& regressions, size_t horizon);
  static Eigen::Vector3d displacementIn(double ahead, const Regressions& regressions,
                                        const DisplacementRegression::Velocities& velocities);

  MotionRegressors regressors_;
  DelayedTargets<MotionRegressors::Values> targets_;
  Regressions translation_;
  Regressions rotation_;
};

}  // namespace sweep_guard_core
