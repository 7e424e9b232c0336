#pragma once

#include <array>
#include <vector>

#include "sweep_guard/prediction/carry.h"
#include "sweep_guard/prediction/extrapolator.h"
#include "sweep_guard/prediction/hindsight.h"
#include "sweep_guard/prediction/velocity.h"

namespace sweep_guard {

/// Learns from the operator how far velocities carry: for each of kLearnedAhead its own recursive least squares fit of
/// the displacement that came on the velocities measured over windows of 0.05, 0.12, 0.3 and 0.8 s, and on the second
/// of them times its speed, for fast motions end sooner.
class DirectExtrapolator : public Extrapolator {
 public:
  DirectExtrapolator();

  void observe(const MotionTrack& track) override;
  Vector6d displacementIn(double ahead) const override;

 private:
  using Velocities = Eigen::Matrix<double, 6, Carry::kVelocities>;  // translation above rotation
  using Carries = std::array<Carry, kLearnedAhead.size()>;

  void measure(const MotionTrack& track);
  static Eigen::Vector3d carried(const Carries& carries, const Carry::Velocities& velocities, double ahead);

  std::vector<Velocity> windows_;
  Velocities velocities_ = Velocities::Zero();
  RecentMean<Eigen::Array2d> speeds_{Eigen::Array2d::Zero()};  // squared, of translation and rotation
  Hindsight<Velocities> hindsight_;
  Carries translation_;
  Carries rotation_;
};

}  // namespace sweep_guard
