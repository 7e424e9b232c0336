#pragma once

#include <map>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_simulation {

/// The positions of all joints of a robot at one moment.
struct StampedPositions {
  sweep_guard_core::Time stamp;
  std::vector<double> positions;  ///< one of each variable of the tree [rad or m]
};

/// Reads the motion of a robot's joints from the sensor_msgs/JointState of a rosbag, which may come from several nodes, each
/// with joints of its own. The motion begins when all joints are known, and ends when the first of them ends.
/// @param topic         empty: the only topic with JointState
/// @param fixed_joints  positions [rad or m] of joints that the bag need not have
/// @returns a state at each stamp of any joint, at least one, in the order of their stamps
/// @throws sweep_guard_core::InvalidInput as readJointBag() does, if the bag has no position of a joint, or if
///     JointTimeline refuses a message
std::vector<StampedPositions> readJointMotion(const std::string& path, const std::string& topic,
                                              const sweep_guard_core::KinematicTree& tree,
                                              const std::map<std::string, double>& fixed_joints);

}  // namespace sweep_guard_simulation
