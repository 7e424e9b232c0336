#pragma once

#include <set>
#include <string>
#include <tuple>

namespace sweep_guard_ros {

/// A topic of another program that describes workpieces.
struct EnvironmentTopic {
  std::string topic;                           ///< not resolved
  std::string id = {};                         ///< of a workpiece to which the messages give no name; empty: the topic
  std::string frame = {};                      ///< of messages that name none; empty: these are refused
  std::set<std::string> namespaces = {};       ///< of markers; empty: all
  bool holds = false;                          ///< workpieces are there also after their publisher has ended
  bool streams = false;                        ///< workpieces are as they were only while messages come
  std::string service = "get_planning_scene";  ///< which gives the whole planning scene

  auto values() const { return std::tie(topic, id, frame, namespaces, holds, streams, service); }  ///< to be compared
};

}  // namespace sweep_guard_ros
