#pragma once

#include <Eigen/Geometry>

#include "guard/moving_mesh.h"
#include "guard/pose_history.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/prediction/pose_predictor.h"

namespace sweep_guard_core {

/// A pose that errs.
struct UncertainPose {
  Eigen::Isometry3d X_MT;
  Matrix6d covariance_M;  ///< of the error: translation [m], then rotation vector [rad], both along the axes of M
};

/// A ball that grows with the number of standard deviations.
struct UncertainBall {
  Eigen::Vector3d center_M;
  double radius;  ///< without deviations [m]
  double sigma;   ///< [m]

  /// Returns how many deviations, negative for less than none, the ball may grow by within a distance of its center.
  double deviationsWithin(double distance) const { return (distance - radius) / sigma; }
};

/// One step of an uncertain path, or a fraction of it. Bounds how far the volumes of pieces of the tool reach, before there is a
/// volume.
///
/// The box of a volume has three axes at right angles. Along each of them, it reaches by at most r_i + m + z sigma_i from the
/// middle of the chord of the pieces' center: r_i from the extents of the pieces and half the chord, m the margin, sigma_i the
/// deviation of a point that may touch the side, z the deviations that the side is moved out by. So no point of the volume is
/// farther from there than |r| + sqrt(3) m + z |sigma|. Whatever the axes, |r| is at most the sum of the pieces' half extents
/// and half of the chord, and |sigma| the root of a trace of the covariance.
class UncertainStep {
 public:
  /// The covariance at any time between the ends lies between theirs.
  /// @param margin  of each volume, and what its poses leave the chord by [m], >= 0
  UncertainStep(const UncertainPose& begin, const UncertainPose& end, double margin);

  /// Returns a ball that holds the volume of each piece within some bounds, along the step or any part of it, with all of its
  /// planes moved out by the deviations by which the ball has grown.
  /// @param pieces_T  bounds of some pieces of the tool (Tool::Node)
  UncertainBall ballAround(const Eigen::AlignedBox3d& pieces_T) const;

 private:
  Eigen::Isometry3d begin_M_;
  Eigen::Isometry3d end_M_;
  double angle_;
  double margin_;
  // The larger ones of both ends:
  double moves_;       // trace of the moves' covariance [m^2]
  double turns_;       // trace of the turns' covariance [rad^2]
  double both_;        // norm of the part that mixes them [m]
  double turns_norm_;  // bounds the largest eigenvalue of the turns' covariance [rad^2]
};

/// Returns whether no point of a box comes nearer to the box around a mesh than a distance [m], whatever the rounding.
bool staysBeside(const Submesh& submesh, const Eigen::AlignedBox3d& points_M, double distance);

/// Returns whether no volume of a piece of a tool that moves through some poses reaches the box around a mesh, as a bound tells before
/// there is a volume.
///
/// The box of a volume has three axes at right angles. Along each of them, it reaches from the middle of the chord of the tool's
/// center by at most the radius of the tool about its center, the growth of the volume, and what the chord and the mesh
/// translation contribute. So no point of the volume is farther from there than half of the chord and of the translation, and
/// sqrt(3) times the rest. The middle is within half of the translation, and the deviation, of the box around the center at the
/// poses.
/// @param poses   of the center of bounds_T()
/// @param margin  of each volume beside the motion of tool and mesh [m], >= 0
bool staysOutOfReach(const Tool& tool, const PoseBounds& poses, const MovingMesh& mesh, double margin);

}  // namespace sweep_guard_core
