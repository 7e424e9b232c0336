#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace sweep_guard_simulation {

/// Interpolates a motion of the tip through given poses at given times by smoothly joined cubics.
class TipScript {
 public:
  /// @param poses  lines `t x y z rx ry rz`: t [s] ascending; x y z [m] of the tip in the fixed frame W; rx ry rz
  ///     [rad] the rotation vector in W that turns the tool from pointing down
  /// @throws sweep_guard_core::InvalidInput if there are fewer than two lines, a line is not seven finite numbers, or a
  ///     time is not later than the previous one
  explicit TipScript(const std::vector<std::string>& poses);

  double begin() const { return poses_.front().t; }  ///< [s]
  double end() const { return poses_.back().t; }     ///< [s]
  /// Returns X_WT at `t` [s], clamped to the first and the last pose.
  Eigen::Isometry3d pose(double t) const;

 private:
  using Vector6d = Eigen::Matrix<double, 6, 1>;
  struct Pose {
    double t;
    Vector6d at;    // [m], [rad]
    Vector6d rate;  // [m/s], [rad/s]
  };

  static Pose parse(const std::string& line);
  void chooseRates();

  std::vector<Pose> poses_;
};

}  // namespace sweep_guard_simulation
