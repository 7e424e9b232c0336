#pragma once

// Idea: an operator does not move at constant velocity, but how recent motion went on can be learned. The displacement
// within a horizon is regressed on recent velocities by recursive least squares [P, Sec. 3.2]; where [P] fits a polynomial
// in time, these regressors are our own. Each of eight horizons has a regression, which learns from a sample as soon as
// the motion within the horizon after it is known; other times are interpolated. Invariant: before anything is learned, the
// prediction is constant velocity; each fit leans towards that of the next shorter horizon, and is blended with constant
// velocity and with rest, the more so the more accurate these are. Cost: a sample completes about one target for each
// horizon, and each takes a rank-1 update for each axis and one solution of 8 x 8; a prediction takes a product of 8
// weights for each axis. The samples of the last second are kept; nothing is allocated unless they become more.

#include <memory>
#include <vector>

#include "prediction/displacement_learner.h"
#include "prediction/exponential_moving_average.h"
#include "prediction/extrapolator.h"
#include "prediction/motion_tracker.h"

namespace sweep_guard_core {

/// Predicts displacements by one DisplacementRegression for each of kLearnedHorizons. They are regressed on velocities: of
/// the newest motion over windows of 50, 120, 300, 800 and 20 ms; one of them times its speed, because fast motions end
/// sooner; one of them at a saturated speed, because slow ones last; and the distance from where it was on average, because
/// a hand returns there.
template <typename Space>
class DirectExtrapolator : public Extrapolator<Space> {
 public:
  using Vector = typename Space::Vector;

  /// @param learned  not null; not checked
  explicit DirectExtrapolator(const std::shared_ptr<LearnedMotion<Space>>& learned);

  void observe(const MotionTracker<Space>& tracker) override;
  Vector displacementIn(double ahead) const override { return learner_.displacementIn(ahead); }
  const Regressors<Space>* regressors() const override { return &regressors_; }

 private:
  void measure(const MotionTracker<Space>& tracker);
  void average(const MotionTracker<Space>& tracker);
  void scale();

  std::vector<Velocity<Space>> windows_;
  ExponentialMovingAverage<typename Space::Speeds> speeds_{Space::Speeds::Zero()};  // squared, of each group
  Vector center_ = Vector::Zero();                                                  // mean of the recent coordinates
  Regressors<Space> regressors_ = Regressors<Space>::Zero();
  DisplacementLearner<Space, kRegressors> learner_;
};

}  // namespace sweep_guard_core
