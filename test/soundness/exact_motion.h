#pragma once

#include <optional>

#include "soundness/real.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core::soundness {

/// Where the points of a tool really are during a motion: the origin goes straight, the orientation turns at constant
/// rate, in long double and without the product's interpolation. The rotation matrices are orthonormal only as far as
/// double goes; the motion is that of the rotations nearest to them, which is another 1e-16 of the lever apart.
///
/// Half a turn apart, two ways are equally short: there the product's choice is taken over.
class ExactMotion {
 public:
  explicit ExactMotion(const Motion& motion);
  /// As seen from a frame M that moves, too.
  explicit ExactMotion(const RelativeMotion& motion);

  /// Position [m] in M of a point of the tool, at a fraction of the motion in [0, 1].
  Vector3r at(Real fraction, const Vector3r& p_T) const;
  /// Position in T of a point of M.
  Vector3r inTool(Real fraction, const Vector3r& p_M) const;
  /// Direction in T of a direction of M.
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
