#include "ros/input/joint_names.h"

#include <algorithm>

#include "ros/tool/robot_tree.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;

}  // namespace

JointNames::JointNames(const sweep_guard_core::KinematicTree& tree, const std::vector<std::optional<double>>& fixed,
                       const Renamed& renamed)
    : names_(tree.variables().size()) {
  for (const auto& [in_messages, joint] : renamed) rename(in_messages, variableNamed(tree, joint));
  for (size_t i = 0; i < names_.size(); ++i) {
    if (names_[i].empty()) names_[i] = tree.variables()[i].name;
    if (!own_.insert(names_[i]).second) {
      throw InvalidInput("'" + printable(names_[i]) +
                         "' is the name of two joints on the topic: give the joint of this name another one");
    }
    if (!fixed[i]) variables_.emplace(names_[i], i);
  }
  for (const auto& [joint, mimic] : tree.mimics()) {
    if (own_.insert(joint).second) continue;
    throw InvalidInput("'" + joint + "' is the name of a joint that mimics '" + tree.variables()[mimic.variable].name +
                       "': publish '" + renamed.at(joint) + "' by its own name or by another one");
  }
}

void JointNames::rename(const std::string& in_messages, size_t variable) {
  if (!names_[variable].empty()) {
    throw InvalidInput("'" + printable(names_[variable]) + "' and '" + printable(in_messages) +
                       "' name one joint: leave one of them out");
  }
  names_[variable] = in_messages;
}

const std::string* JointNames::firstIn(const sensor_msgs::JointState& message) const {
  const auto is_ours = [this](const std::string& name) { return variables_.count(name) != 0; };
  const auto first = std::find_if(message.name.begin(), message.name.end(), is_ours);
  return first == message.name.end() ? nullptr : &*first;
}

std::optional<size_t> JointNames::variable(const std::string& name_in_messages) const {
  const auto found = variables_.find(name_in_messages);
  return found == variables_.end() ? std::nullopt : std::optional(found->second);
}

void JointNames::find(const sensor_msgs::JointState& message,
                      std::vector<sweep_guard_core::JointTimeline::Position>& positions) const {
  positions.clear();
  const std::string* const first = firstIn(message);
  if (first == nullptr) return;
  if (message.position.size() != message.name.size()) {
    throw InvalidInput("it names " + std::to_string(message.name.size()) + " joints, '" + printable(*first) +
                       "' among them, and has " + std::to_string(message.position.size()) +
                       " positions: publish one for each");
  }
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
