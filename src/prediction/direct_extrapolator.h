#pragma once

#include <array>
#include <vector>

#include "prediction/delayed_targets.h"
#include "prediction/displacement_regression.h"
#include "prediction/extrapolator.h"
#include "prediction/velocity.h"

namespace sweep_guard_core {

/// Learns the operator's displacements from velocities. For each of kLearnedHorizons, a recursive least squares fit
/// regresses the displacement on the velocities measured over windows of 0.05, 0.12, 0.3 and 0.8 s, and on the second
/// of these velocities times its speed, because fast motions end sooner.
class DirectExtrapolator : public Extrapolator {
 public:
  DirectExtrapolator();

  void observe(const PoseTracker& tracker) override;
  Vector6d displacementIn(double ahead) const override;

 private:
  using Velocities = Eigen::Matrix<double, 6, DisplacementRegression::kVelocities>;  // translation above rotation
  using Regressions = std::array<DisplacementRegression, kLearnedHorizons.size()>;

  void measure(const PoseTracker& tracker);
  static Eigen::Vector3d displacementIn(double ahead, const Regressions& regressions,
                                        const DisplacementRegression::Velocities& velocities);

  std::vector<Velocity> windows_;
  Velocities velocities_ = Velocities::Zero();
  ExponentialMovingAverage<Eigen::Array2d> speeds_{Eigen::Array2d::Zero()};  // squared, of translation and rotation
  DelayedTargets<Velocities> targets_;
  Regressions translation_;
  Regressions rotation_;
};

}  // namespace sweep_guard_core
