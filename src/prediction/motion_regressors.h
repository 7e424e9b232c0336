#pragma once

#include <vector>

#include "prediction/displacement_regression.h"
#include "prediction/exponential_moving_average.h"
#include "prediction/motion_tracker.h"

namespace sweep_guard_core {

/// Measures what displacements are regressed on. All are velocities: of the newest motion over windows of 50, 120, 300,
/// 800 and 20 ms; one of them times its speed, because fast motions end sooner; one of them at a saturated speed,
/// because slow ones last; and the distance from where it was on average, because a hand returns there.
template <typename Space>
class MotionRegressors {
 public:
  /// Of a tool: translation [m/s] above rotation [rad/s]. One regressor per column.
  using Values = Eigen::Matrix<double, Space::kSize, kRegressors>;

  MotionRegressors();

  void observe(const MotionTracker<Space>& tracker);
  const Values& values() const { return values_; }

 private:
  void average(const MotionTracker<Space>& tracker);
  void scale();

  std::vector<Velocity<Space>> windows_;
  ExponentialMovingAverage<typename Space::Speeds> speeds_{Space::Speeds::Zero()};  // squared, of each group
  typename Space::Vector center_ = Space::Vector::Zero();                           // mean of the recent coordinates
  Values values_ = Values::Zero();
};

}  // namespace sweep_guard_core
