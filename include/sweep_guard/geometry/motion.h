#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// A rigid motion of the tool frame T between two poses, in mesh frame M: the origin of T moves straight at constant
/// speed, and T turns about one axis at constant rate, by the smaller angle [P, Sec. 3.1: "straight line
/// displacement"].
/// Between orientations half a turn apart, the axis is the one that slerp chooses. Both poses must be finite, with
/// orthonormal rotations (not checked).
struct Motion {
  Eigen::Isometry3d X_MT_start = Eigen::Isometry3d::Identity();  ///< translation [m]
  Eigen::Isometry3d X_MT_end = Eigen::Isometry3d::Identity();    ///< translation [m]
  /// Upper bound [m] on the distance of a tool point from where it would be if it moved straight from pose to pose at
  /// constant speed, for a motion in a turning M or one that replaces several. 0 otherwise: chordError() bounds it.
  double deviation_bound = 0.0;
  /// Translation of the mesh during the motion [m], in M. The mesh is tested where it is at the end, so the tool may be
  /// anywhere on [pose, pose + mesh_translation] at any time.
  Eigen::Vector3d mesh_translation = Eigen::Vector3d::Zero();

  /// Returns the rotation angle from start to end [rad], in [0, pi].
  double angle() const;
  /// Returns the axis of the rotation in T, unit; any unit vector if the angle is 0.
  Eigen::Vector3d axis_T() const;
  /// Returns the pose X_MT at a fraction of the motion, in [0, 1].
  Eigen::Isometry3d at(double fraction) const;
};

/// Returns the smallest number, >= 1, of equal sub-motions of which none turns by more than `max_rotation`.
/// @param angle         rotation of the whole motion [rad], >= 0
/// @param max_rotation  [rad], > 0 (asserted)
size_t subMotionCount(double angle, double max_rotation);

/// Cuts the poses of a motion into the fewest equal sub-motions that turn by at most `max_rotation` each. They are end
/// to end: nothing between them is left out. Their deviation_bound and mesh_translation are 0, whatever the motion's.
/// @param max_rotation  [rad], > 0 (asserted)
/// @param buffer        provides the memory of the result; its contents are replaced
[[nodiscard]] std::vector<Motion> split(const Motion& motion, double max_rotation, std::vector<Motion> buffer = {});

/// The simultaneous motions of the tool and of the mesh frame M in the fixed frame W. Seen from a turning M, the tool
/// moves on an arc about the origin of M, even if the tool itself does not turn.
struct RelativeMotion {
  Motion tool_W;   ///< of T in W: X_MT_start holds X_WT at the start
  Motion frame_W;  ///< of M in W: X_MT_start holds X_WM at the start
};

/// Returns the tool's motion in M, cut into the fewest equal sub-motions in which tool and frame together turn by at
/// most `max_rotation`. Their deviation_bound covers the turn of M and that of tool_W: of a tool point, at any time, from
/// where it would be if T moved as a Motion. Their mesh_translation is 0. Ignores the mesh_translation of tool_W and
/// frame_W, and the deviation_bound of frame_W.
/// @param max_rotation  [rad], > 0 (asserted)
/// @param tool_radius   largest distance of a tool point from the origin of T [m], >= 0
/// @param buffer        provides the memory of the result; its contents are replaced
[[nodiscard]] std::vector<Motion> split(const RelativeMotion& motion, double max_rotation, double tool_radius,
                                        std::vector<Motion> buffer = {});

/// What bounds how far a tool leaves the straight path between two poses, seen from M.
struct RelativeTurn {
  double tool;              ///< angle by which the tool turns, or more [rad]
  double frame;             ///< angle by which M turns, or more [rad]
  Eigen::Vector3d start_W;  ///< from the origin of M to that of T at the start, along the axes of W [m]
  Eigen::Vector3d end_W;    ///< the same at the end
};

/// Returns a bound [m] on the deviation of a tool point, seen from M, from its straight path at constant speed between
/// the ends of the motion.
/// @param tool_radius  largest distance of a tool point from the origin of T [m], >= 0
double chordError(const RelativeMotion& motion, double tool_radius);
double chordError(const RelativeTurn& turn, double tool_radius);

/// Returns an upper bound on the angle between two orientations [rad]: at most pi / 2 times the angle, and found in a fraction
/// of the time.
double angleBound(const Eigen::Matrix3d& R_start, const Eigen::Matrix3d& R_end);

/// Returns a bound [m] on the distance between the arc of a tool point, while the tool turns, and the chord that
/// replaces the arc. A swept volume built on chords is conservative once it is grown by this. It is radius * angle^2 /
/// 8: linear interpolation of a curve over [0, 1] errs by at most an eighth of its largest |x''|.
/// @param radius  largest distance of a tool point from the rotation axis through the tool frame's origin [m], >= 0
/// @param angle   rotation between the two poses [rad], in [0, pi]
double chordError(double radius, double angle);

/// A pose on a path of the tool frame T through a mesh frame M.
struct PathPoint {
  Duration time{};                                         ///< since an arbitrary time, not decreasing
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();  ///< translation [m]
  /// Bound on the deviation [m] of a tool point, between the previous point and this one, from a straight line at
  /// constant speed.
  double deviation_bound = 0.0;
};
using Path = std::vector<PathPoint>;

/// Returns one motion that replaces several: from one point of a path to a later one, straight and at constant speed.
/// Its deviation_bound bounds the distance, at any time, of any tool point from its position on the path.
///
/// A time of impact found on the merged motion with deviation_bound as margin is never late. It is early by at most the
/// time in which the tool approaches by twice deviation_bound. Between points with equal times, the tool counts as
/// being at every place of the path.
/// @param first        index of a point
/// @param last         index of a point, > first
/// @param tool_radius  largest distance of a tool point from the origin of T [m], >= 0
Motion mergedMotion(const Path& path, size_t first, size_t last, double tool_radius);

/// Returns the index, at most `last`, of the last point of a merged motion from `first` that keeps the limits; first +
/// 1 if there is none. Searches by doubling and halving, which costs little more than reading the path; a longer motion
/// may exist.
/// @param max_deviation  of the path from the merged motion [m], >= 0
/// @param max_rotation   of the merged motion [rad], > 0
size_t endOfMergedMotion(const Path& path, size_t first, size_t last, double tool_radius, double max_deviation,
                         double max_rotation);

}  // namespace sweep_guard_core
