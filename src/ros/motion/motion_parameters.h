#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "ros/motion/pose_source.h"
#include "ros/motion/source_parameters.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/motion/motion_guard.h"
#include "sweep_guard/motion/pose_leash.h"

namespace sweep_guard_ros {

enum class CommandType { kTwistStamped, kTwist, kPoseStamped, kJointJog, kJointTrajectory, kVelocityArray };

/// Returns whether velocities of joints are commanded.
inline bool isOfJoints(CommandType type) { return type >= CommandType::kJointJog; }

/// Holds all parameters of motion_guard, checked. loadMotionParameters() defines key, unit, range, default and effect of
/// each; doc/interface.md and config/motion_guard.yaml are generated from them.
struct MotionParameters {
  CommandType command_type;
  PoseSource tool;
  std::string command_frame;        ///< axes of an unstamped twist
  std::string command_point;        ///< tf frame whose origin the command is of
  double linear_scale;              ///< [m/s] in a unit of a command
  double angular_scale;             ///< [rad/s] in a unit of a command
  std::string guard;                ///< name of the guard's node
  JointSource joint_source;         ///< of commands of joints
  std::vector<std::string> joints;  ///< of the velocities in an array, in their order
  bool incremental;                 ///< see PoseFollower; of poses, as the following
  sweep_guard_core::PoseLeash::Options leash;
  sweep_guard_core::MotionGuardOptions options;
  int halt_messages;                     ///< zeros after the commands have stopped; 0: without end
  ParameterReader::Settings settings;    ///< as read
  std::vector<ParameterInfo> described;  ///< always the same keys in the same order
};

/// Reads the private parameters. A missing parameter takes its default. Warns of each parameter that is not read.
/// @throws sweep_guard_core::InvalidInput naming key, value and range if one has the wrong type, is NaN or is out of range
MotionParameters loadMotionParameters(const ros::NodeHandle& private_node);

}  // namespace sweep_guard_ros
