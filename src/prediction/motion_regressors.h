#pragma once

#include <string>
#include <vector>

#include "prediction/displacement_regression.h"
#include "prediction/exponential_moving_average.h"
#include "prediction/pose_tracker.h"
#include "prediction/velocity.h"

namespace sweep_guard_core {

/// Measures what displacements are regressed on. All are velocities: of the newest motion over windows of 50, 120, 300,
/// 800 and 20 ms; one of them times its speed, because fast motions end sooner; one of them at a saturated speed,
/// because slow ones last; and the distance from where the tool was on average, because a hand returns there.
class MotionRegressors {
 public:
  /// Translation [m/s] above rotation [rad/s]; one regressor per column.
  using Values = Eigen::Matrix<double, 6, DisplacementRegression::kVelocities>;

  /// The tool's mean speeds, which scale two of the regressors.
  struct Speeds {
    Eigen::Array2d squares;  ///< of translation [m^2/s^2] and rotation [rad^2/s^2], >= 0
    double time;             ///< that they are known from [s], > 0
  };

  /// Returns a name for each regressor.
  static std::vector<std::string> names();

  MotionRegressors();

  void observe(const PoseTracker& tracker);
  const Values& values() const { return values_; }

  Speeds speeds() const { return {speeds_.mean(), speeds_.weight()}; }
  void begin(const Speeds& speeds);

 private:
  void average(const PoseTracker& tracker);
  void scale();

  std::vector<Velocity> windows_;
  ExponentialMovingAverage<Eigen::Array2d> speeds_{Eigen::Array2d::Zero()};  // squared, of translation and rotation
  Vector6d center_ = Vector6d::Zero();                                       // mean of the recent coordinates
  Values values_ = Values::Zero();
};

}  // namespace sweep_guard_core
