#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace sweep_guard_core {

/// A rigid motion of the tool frame T between two poses, in mesh frame M: the origin of T goes straight at constant
/// speed, the orientation turns about one axis at constant rate, the shorter way [P, Sec. 3.1: "straight line
/// displacement"]. Between orientations half a turn apart the axis is not unique; slerp's choice holds.
struct Motion {
  Eigen::Isometry3d X_MT_start = Eigen::Isometry3d::Identity();  ///< translation [m]
  Eigen::Isometry3d X_MT_end = Eigen::Isometry3d::Identity();    ///< translation [m]
  /// Bound on how far a tool point leaves its chord because M turns itself, or because the motion stands for several
  /// [m], >= 0.
  double deviation_bound = 0.0;
  /// Besides, the tool may be anywhere from where it is to this far on, at any time [m]: so looks, from a mesh that
  /// goes the other way meanwhile, at whatever pace.
  Eigen::Vector3d mesh_translation = Eigen::Vector3d::Zero();

  /// Rotation from start to end [rad], in [0, pi].
  double angle() const;
  /// Axis of that rotation in T, unit; any unit vector where the angle is 0.
  Eigen::Vector3d axis_T() const;
  /// Pose at a fraction of the motion, in [0, 1].
  Eigen::Isometry3d at(double fraction) const;
};

/// How many equal parts, at the least, a motion is cut into so that none turns by more than `max_rotation`; >= 1.
/// @param angle         that it turns by [rad], >= 0
/// @param max_rotation  [rad], > 0
size_t subMotionCount(double angle, double max_rotation);

/// The motion cut into the fewest equal parts that turn by at most `max_rotation` each; end to end, so that nothing
/// between them is left out.
/// @param max_rotation  [rad], > 0
/// @param[out] parts    what was in it is replaced
void split(const Motion& motion, double max_rotation, std::vector<Motion>& parts);
std::vector<Motion> split(const Motion& motion, double max_rotation);

/// The tool and the mesh frame M moving side by side in the fixed frame W. Each goes straight and turns there; seen
/// from an M that turns, the tool runs along an arc about M's origin, however little it turns itself.
struct RelativeMotion {
  Motion tool_W;   ///< of T in W
  Motion frame_W;  ///< of M in W: its X_MT_start is X_WM at the start
};

/// The tool's motion in M, cut into the fewest equal parts in which tool and frame together turn by at most
/// `max_rotation`.
/// @param max_rotation  [rad], > 0
/// @param tool_radius   largest distance of a tool point from the origin of T [m], >= 0
std::vector<Motion> split(const RelativeMotion& motion, double max_rotation, double tool_radius);
/// @param[out] sub_motions_M  what was in it is replaced
void split(const RelativeMotion& motion, double max_rotation, double tool_radius, std::vector<Motion>& sub_motions_M);

/// Bound on how far a tool point, seen from M, is off the straight line at constant speed from where it starts to where
/// it ends [m].
/// @param tool_radius  largest distance of a tool point from the origin of T [m], >= 0
double chordError(const RelativeMotion& motion, double tool_radius);

/// Greatest distance [m] between the arc that a tool point runs along while the tool turns and the chord that replaces
/// it. A swept volume built on chords is conservative once it is grown by this. Bound: linear interpolation of a curve
/// with |x''| = radius * angle^2 errs by at most an eighth of that.
/// @param radius  largest distance of a tool point from the rotation axis through the tool frame's origin [m], >= 0
/// @param angle   rotation between the two poses [rad], in [0, pi]
double chordError(double radius, double angle);

}  // namespace sweep_guard_core
