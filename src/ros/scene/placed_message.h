#pragma once

#include <Eigen/Geometry>
#include <string>

#include "ros/scene/message_value.h"
#include "scene/scene_object.h"

namespace sweep_guard_ros {

/// A pose in a message. A quaternion of zeros, which is not set, is the identity.
struct PoseInMessage {
  Eigen::Isometry3d X;  ///< [m]
  bool is_unset;        ///< the quaternion is, and the position is 0
};

/// @throws sweep_guard_core::InvalidInput if it is not finite, or the norm of its quaternion is off 1 by more than 0.1
PoseInMessage poseIn(const MessageValue& pose);

/// Returns an object with frame and stamp of a header, without a surface.
/// @param fallback  frame if the header names none
/// @throws sweep_guard_core::InvalidInput if there is none either
sweep_guard_core::SceneObject objectAt(const MessageValue& header, const std::string& fallback);

}  // namespace sweep_guard_ros
