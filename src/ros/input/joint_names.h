#pragma once

#include <sensor_msgs/JointState.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "sweep_guard/kinematics/joint_timeline.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_ros {

/// Finds the joints of a robot in messages.
class JointNames {
 public:
  /// Names of joints in the robot description, by their names in messages.
  using Renamed = std::map<std::string, std::string>;

  /// @param fixed    from fixedPositions(): joints with a position are passed over in messages
  /// @param renamed  joints that are not here have the same name in messages as in the robot description
  /// @throws sweep_guard_core::InvalidInput if a joint of `renamed` is none of the tree, mimics another one, has two names in
  ///     messages, or takes the name of another one, for which none is left, or of one that mimics another
  JointNames(const sweep_guard_core::KinematicTree& tree, const std::vector<std::optional<double>>& fixed,
             const Renamed& renamed = {});

  /// Returns the first name in a message of a joint of the robot that is not fixed; null: the message has none.
  const std::string* firstIn(const sensor_msgs::JointState& message) const;

  /// Returns the positions of the robot's joints that are not fixed; all others are passed over.
  /// @param[out] positions  overwritten; its buffer is used again
  /// @throws sweep_guard_core::InvalidInput if one is named and there are not as many positions as names
  void find(const sensor_msgs::JointState& message,
            std::vector<sweep_guard_core::JointTimeline::Position>& positions) const;

  /// Returns whether a joint of the robot has this name in messages, also one that is fixed or mimics another one.
  bool isOwn(const std::string& name_in_messages) const { return own_.count(name_in_messages) != 0; }
  /// Returns the variable of the joint of this name in messages; empty: it has none.
  std::optional<size_t> variable(const std::string& name_in_messages) const;
  /// Returns the name in messages of the joint of a variable.
  const std::string& inMessages(size_t variable) const { return names_[variable]; }

 private:
  void rename(const std::string& in_messages, size_t variable);

  std::vector<std::string> names_;                     // by variable
  std::unordered_map<std::string, size_t> variables_;  // by name in messages; without those that are fixed
  std::set<std::string> own_;                          // names in messages, of joints that mimic others, too
};

/// Returns the position of each variable that has one by the name of its joint [rad or m].
std::vector<std::optional<double>> fixedPositions(const sweep_guard_core::KinematicTree& tree,
                                                  const std::map<std::string, double>& fixed_joints);

}  // namespace sweep_guard_ros
