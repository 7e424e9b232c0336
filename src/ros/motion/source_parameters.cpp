#include "ros/motion/source_parameters.h"

#include <ros/names.h>

#include "sweep_guard/common/error.h"

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
  std::string guard = read.name("guard", "/sweep_guard",
                                "Name of the guard's node, whose proximity, tool_balls and warning are listened to.");
  std::string error;
  if (ros::names::validate(guard, error)) return guard;
  throw sweep_guard_core::InvalidInput("parameter guard is no name of a node: " + error);
}

sweep_guard_core::Duration readSeconds(ParameterReader& read, const std::string& key,
                                       sweep_guard_core::Duration fallback, const ParameterRange& range,
                                       const std::string& effect) {
  return sweep_guard_core::fromSeconds(read.number(key, sweep_guard_core::toSeconds(fallback), range, effect));
}

}  // namespace sweep_guard_ros
