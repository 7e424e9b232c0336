#include "ros/motion/source_parameters.h"

#include "ros/tool/tool_model.h"

namespace sweep_guard_ros {

PoseSource readPoseSource(ParameterReader& read) {
  PoseSource tool;
  tool.fixed_frame = read.name("fixed_frame", "world", "tf frame of the planes: the guard's.");
  const std::string source = read.choice("tool_source", "topic", {"topic", "tf"},
                                         "topic: poses arrive on `tool_pose`. tf: the tool is the frame tool_frame.");
  tool.source = source == "tf" ? ToolSource::kTf : ToolSource::kTopic;
  tool.frame = read.name("tool_frame", "tool", "tf frame of the tool: the guard's.");
  return tool;
}

JointSource readJointSource(ParameterReader& read, const std::string& tool_frame, bool needed) {
  const std::string description =
      read.name("tool/robot_description", "robot_description",
                "Joints only: parameter with the URDF, searched from the node's namespace upwards.");
  read.ignore(description);
  const auto renamed = read.textsByName(
      "tool/joint_names", "Joints only: names in the URDF by names in messages, where they differ: the guard's.");
  if (!needed) return {};
  const std::string urdf = read.searchText(description);
  if (urdf.empty()) {
    throw sweep_guard_core::InvalidInput("there is no robot description in the parameter '" + description +
                                         "': load one, or name it in tool/robot_description");
  }
  JointSource joints;
  joints.tree = std::make_shared<const sweep_guard_core::KinematicTree>(loadTree(urdf, tool_frame));
  joints.names = std::make_shared<const JointNames>(*joints.tree, fixedPositions(*joints.tree, {}), renamed);
  return joints;
}

std::string readGuard(ParameterReader& read) {
  return read.node("guard", "sweep_guard", "Node of the guard to listen to, relative to the namespace of this node.");
}

sweep_guard_core::Duration readSeconds(ParameterReader& read, const std::string& key,
                                       sweep_guard_core::Duration fallback, const ParameterRange& range,
                                       const std::string& effect) {
  return sweep_guard_core::fromSeconds(read.number(key, sweep_guard_core::toSeconds(fallback), range, effect));
}

}  // namespace sweep_guard_ros
