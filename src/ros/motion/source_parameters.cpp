#include "ros/motion/source_parameters.h"

namespace sweep_guard_ros {

PoseSource readPoseSource(ParameterReader& read) {
  PoseSource tool;
  tool.fixed_frame = read.name("fixed_frame", "world", "tf frame that the planes are in: as that of the guard.");
  const std::string source =
      read.choice("tool_source", "topic", {"topic", "tf"},
                  "topic: poses of the tool arrive on `tool_pose`. tf: the tool is the frame tool_frame in tf.");
  tool.source = source == "tf" ? ToolSource::kTf : ToolSource::kTopic;
  tool.frame = read.name("tool_frame", "tool", "tf frame of the tool: as that of the guard.");
  return tool;
}

std::string readGuard(ParameterReader& read) {
  return read.node("guard", "sweep_guard",
                   "Name of the guard's node, whose proximity, tool_balls and warning are listened to. Without a slash "
                   "at its front: in the namespace of this node.");
}

sweep_guard_core::Duration readSeconds(ParameterReader& read, const std::string& key,
                                       sweep_guard_core::Duration fallback, const ParameterRange& range,
                                       const std::string& effect) {
  return sweep_guard_core::fromSeconds(read.number(key, sweep_guard_core::toSeconds(fallback), range, effect));
}

}  // namespace sweep_guard_ros
