#pragma once

#include <memory>
#include <string>

#include "ros/input/joint_names.h"
#include "ros/motion/pose_source.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_ros {

/// Reads fixed_frame, tool_source (kTopic or kTf) and tool_frame. The caller sets `silence`.
PoseSource readPoseSource(ParameterReader& read);

/// The joints of a robot: the links below the tool frame, the joints that move them, and how messages name these. Null: joints
/// are not read.
struct JointSource {
  std::shared_ptr<const sweep_guard_core::KinematicTree> tree;
  std::shared_ptr<const JointNames> names;
};

/// @param tool_frame  above the joints
/// @param needed      false: the parameters are read, and have no effect
/// @throws sweep_guard_core::InvalidInput if they are needed and there is no robot description, or names that do not fit it
JointSource readJointSource(ParameterReader& read, const std::string& tool_frame, bool needed);

/// Reads the name of the guard's node, and resolves it.
/// @throws sweep_guard_core::InvalidInput if it is no name of a node
std::string readGuard(ParameterReader& read);

/// Reads a number of seconds.
/// @param range  its unit is s
sweep_guard_core::Duration readSeconds(ParameterReader& read, const std::string& key,
                                       sweep_guard_core::Duration fallback, const ParameterRange& range,
                                       const std::string& effect);

}  // namespace sweep_guard_ros
