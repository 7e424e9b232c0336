#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace sweep_guard_simulation {

/// A motion of the tip through given poses at given times: a cubic from each to the next, smooth where they join.
class TipScript {
 public:
  /// @param poses  a line each: `t x y z rx ry rz`; t [s] ascending, x y z [m] of the tip in the fixed frame W, rx ry
  /// rz
  ///     the rotation vector [rad] in W by which the tool is turned from pointing down
  /// @throws sweep_guard_core::InvalidInput if there are fewer than two lines, one is not seven finite numbers, or a time
  /// does
  ///     not ascend
  explicit TipScript(const std::vector<std::string>& poses);

  double begin() const { return poses_.front().t; }  ///< [s]
  double end() const { return poses_.back().t; }     ///< [s]
  /// X_WT at `t` [s]; before the first time the first pose, after the last the last one.
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
