#pragma once

#include <map>
#include <string>
#include <vector>

#include "ros/tool/robot_description.h"
#include "sweep_guard/kinematics/joint_plan.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_ros {

/// What lies between a frame and some links of a robot: the joints that move them relative to each other. Its root is the
/// lowest link above all of them, or one of them.
struct RobotTree {
  sweep_guard_core::KinematicTree tree;
  size_t frame;               ///< index in the tree; TreeLink::kRoot: the root
  std::vector<size_t> links;  ///< the same of each link
  sweep_guard_core::JointsBesideTree beside;
};

/// @throws sweep_guard_core::InvalidInput naming a joint between them that has no axis or no limits, mimics a joint that
///     does not exist, or is planar or floating
RobotTree treeOf(const RobotDescription& robot, const urdf::Link& frame, const std::vector<const urdf::Link*>& links);

/// Returns the position of each variable: the given one, or else the one closest to 0 within its limits.
/// @param given  positions [rad or m] by the name of a joint
/// @throws sweep_guard_core::InvalidInput if a position is not finite or beyond the limits of its joint, or if the joint does
///     not exist or mimics another one
std::vector<double> positionsOf(const RobotDescription& robot, const sweep_guard_core::KinematicTree& tree,
                                const std::map<std::string, double>& given);

/// Returns the index of the variable of a joint.
/// @throws sweep_guard_core::InvalidInput if the joint has none, naming those that have one, or the one that it mimics
size_t variableNamed(const sweep_guard_core::KinematicTree& tree, const std::string& joint);

}  // namespace sweep_guard_ros
