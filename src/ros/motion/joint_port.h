#pragma once

#include <memory>

#include "ros/motion/command_port.h"
#include "ros/motion/joint_input.h"

namespace sweep_guard_ros {

/// Returns the port of commanded velocities of joints, in the message type that command_type says.
/// @param joints  must outlive it
std::unique_ptr<CommandPort> makeJointPort(const PortSetup& setup, const JointInput& joints);

}  // namespace sweep_guard_ros
