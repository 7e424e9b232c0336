#pragma once

#include <sensor_msgs/JointState.h>

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "sweep_guard/kinematics/joint_timeline.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_ros {

/// Finds the joints of a robot in messages.
class JointNames {
 public:
  explicit JointNames(const sweep_guard_core::KinematicTree& tree);

  /// Returns the positions of the robot's joints; those of others are passed over.
  /// @param[out] positions  overwritten; its buffer is used again
  /// @throws sweep_guard_core::InvalidInput if there are not as many positions as names
  void find(const sensor_msgs::JointState& message,
            std::vector<sweep_guard_core::JointTimeline::Position>& positions) const;

 private:
  std::unordered_map<std::string, size_t> variables_;  // by name of the joint
};

/// Returns the position of each variable that has one by the name of its joint [rad or m].
std::vector<std::optional<double>> fixedPositions(const sweep_guard_core::KinematicTree& tree,
                                                  const std::map<std::string, double>& fixed_joints);

}  // namespace sweep_guard_ros
