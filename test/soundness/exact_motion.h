#pragma once

#include <optional>

#include "soundness/real.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core::soundness {

/// Computes the positions of a tool's points during a motion in long double, without the product's interpolation: the
/// origin moves straight, the orientation turns at constant rate. The rotation matrices are orthonormal only in double;
/// the motion uses the nearest rotations, which differ by 1e-16 of the lever.
///
/// At half a turn both ways are equally short: there it takes the product's choice.
class ExactMotion {
 public:
  explicit ExactMotion(const Motion& motion);
  /// Describes the motion relative to a moving frame M.
  explicit ExactMotion(const RelativeMotion& motion);

  /// Returns the position in M [m] of a point of the tool, at a fraction of the motion in [0, 1].
  Vector3r at(Real fraction, const Vector3r& p_T) const;
  /// Returns the position in T [m] of a point of M.
  Vector3r inTool(Real fraction, const Vector3r& p_M) const;
  /// Returns the direction in T of a direction in M.
  Vector3r directionInTool(Real fraction, const Vector3r& direction_M) const;

 private:
  struct Path {
    explicit Path(const Motion& motion);
    Vector3r origin(Real fraction) const { return from + fraction * (to - from); }
    Matrix3r rotation(Real fraction) const;

    Vector3r from;
    Vector3r to;
    Eigen::Quaternion<Real> start;
    Eigen::Quaternion<Real> end;
  };

  Path tool_;
  std::optional<Path> frame_;
};

}  // namespace sweep_guard_core::soundness
