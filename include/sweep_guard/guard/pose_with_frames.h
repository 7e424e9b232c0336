#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/kinematics/robot_motion.h"

namespace sweep_guard_core {

/// The pose of one rigid body of the tool.
struct BodyPose {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  ///< of its frame B, translation [m]
  /// Bound [m], >= 0, on the distance of a point of the body, at any time since the previous pose, from where it would be if
  /// the body moved as Motion says.
  double deviation_bound = 0.0;
};

/// The pose of the tool frame T, and of every mesh frame M, in the fixed frame W at one moment. All poses must
/// be finite, with orthonormal rotations (not checked).
struct PoseWithFrames {
  Time stamp;
  SteadyTime received;                                     ///< when the pose arrived
  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();  ///< translation [m]
  std::map<std::string, Eigen::Isometry3d> X_WM =
      {};                             ///< [m], by name of M; a frame whose transform is missing is left out
  std::vector<BodyPose> bodies = {};  ///< of each body of the guarded tool; empty: it is one body, in T
  RobotState state = {};              ///< of the robot whose bodies these are; means nothing without any
  /// What jumped on the way to this pose, in words, as in "joint 'elbow' jumped: 130 rad/s": the motion does not go on from
  /// there. Empty: nothing did.
  std::string jump = {};

  BodyPose body(size_t i) const { return bodies.empty() ? BodyPose{X_WT} : bodies[i]; }
};

}  // namespace sweep_guard_core
