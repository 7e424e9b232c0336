#pragma once

#include <Eigen/Geometry>
#include <boost/container/small_vector.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/common/time.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/kinematics/robot_motion.h"

namespace sweep_guard_core {

/// The pose of one rigid body of the tool.
struct BodyPose {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  ///< of its frame B, translation [m]
  /// Bound [m], >= 0, on the distance of a point of the body, at any time since the previous pose, from where it would be if
  /// the body moved as Motion says.
  double deviation_bound = 0.0;
};

/// Without an allocation if there is one.
using BodyPoses = boost::container::small_vector<BodyPose, 1, std::allocator<BodyPose>>;

/// What a static transform that changed has placed anew: it did not move there.
struct PlacedAnew {
  bool tool = false;                  ///< the tool with all its bodies
  std::set<std::string> frames = {};  ///< frames of workpieces
  bool goes_on = false;               ///< these move here from the pose before, which was placed anew as well

  bool concerns(const std::string& frame) const { return tool || frames.count(frame) != 0; }
};

/// How a frame moves that was measured earlier than a pose of the tool.
struct FrameDrift {
  Vector6d velocity_W = Vector6d::Zero();  ///< of its origin [m/s], and angular [rad/s]
  Duration age{};                          ///< of its newest measured pose, at the pose of the tool; >= 0

  /// Returns a bound [m] on the displacement of a point of the frame in this time.
  /// @param radius  distance of the point from the origin of the frame [m], >= 0
  double displacement(double radius) const;
};

/// The pose of the tool frame T, and of every mesh frame M, in the fixed frame W at one moment. All poses must
/// be finite, with orthonormal rotations (not checked).
struct PoseWithFrames {
  Time stamp;
  SteadyTime received;                                     ///< when the pose arrived
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< translation [m]
  std::map<std::string, Eigen::Isometry3d> X_WM =
      {};                               ///< [m], by name of M; a frame whose transform is missing is left out
  BodyPoses bodies = {BodyPose{X_WT}};  ///< of each body of the guarded tool; a rigid one is one body, which is at X_WT
  RobotState state = {};                ///< of the robot whose bodies these are; without joints for a rigid tool
  /// What jumped on the way to this pose, in words, as in "joint 'elbow' jumped: 130 rad/s": the motion does not go on from
  /// there. Empty: nothing did.
  std::string jump = {};
  /// What did not move to this pose from the one before, because a static transform has changed: its motion goes on from
  /// here. For all else this pose is no part of the motion. Poses that are placed anew repeat a path in no time.
  std::optional<PlacedAnew> anew = {};
  /// Of the frames of X_WM that are followed, see placeFollowed(), or were placed anew since the pose before.
  std::map<std::string, FrameDrift> drifts = {};
};

/// Copies a pose. Allocates nothing if both have the same frames and bodies.
void assign(PoseWithFrames& to, const PoseWithFrames& from);

/// Places the frames that move on their own where they are at the stamp of a pose, as far as that is known.
/// @param[in,out] pose  its X_WM and drifts of these frames are replaced
void placeFollowed(const FrameMotions& frames, PoseWithFrames& pose);

}  // namespace sweep_guard_core
