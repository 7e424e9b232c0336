#include "ros/input/joint_names.h"

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

JointNames::JointNames(const sweep_guard_core::KinematicTree& tree) {
  const auto& variables = tree.variables();
  for (size_t i = 0; i < variables.size(); ++i) variables_.emplace(variables[i].name, i);
}

void JointNames::find(const sensor_msgs::JointState& message,
                      std::vector<sweep_guard_core::JointTimeline::Position>& positions) const {
  if (message.position.size() != message.name.size()) {
    throw sweep_guard_core::InvalidInput("it names " + std::to_string(message.name.size()) + " joints and has " +
                                         std::to_string(message.position.size()) + " positions: publish one for each");
  }
  positions.clear();
  for (size_t i = 0; i < message.name.size(); ++i) {
    const auto variable = variables_.find(message.name[i]);
    if (variable != variables_.end()) positions.push_back({variable->second, message.position[i]});
  }
}

std::vector<std::optional<double>> fixedPositions(const sweep_guard_core::KinematicTree& tree,
                                                  const std::map<std::string, double>& fixed_joints) {
  std::vector<std::optional<double>> fixed;
  for (const auto& variable : tree.variables()) {
    const auto joint = fixed_joints.find(variable.name);
    fixed.push_back(joint == fixed_joints.end() ? std::nullopt : std::optional(joint->second));
  }
  return fixed;
}

}  // namespace sweep_guard_ros
