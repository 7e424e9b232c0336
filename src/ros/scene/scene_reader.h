#pragma once

#include <memory>
#include <string>

#include "ros/scene/environment_topic.h"
#include "ros/scene/message_value.h"
#include "scene/planning_scene.h"

namespace sweep_guard_ros {

/// Finds in the messages of a topic which workpieces are there. One thread.
class SceneReader {
 public:
  virtual ~SceneReader() = default;

  /// @param now  for messages without a stamp
  /// @throws sweep_guard_core::InvalidInput if the message cannot be read; what was there before then stays
  virtual sweep_guard_core::SceneUpdate read(const MessageValue& message, sweep_guard_core::Time now) = 0;
  /// Returns what has changed by time alone. To be called 10 times a second.
  virtual sweep_guard_core::SceneUpdate expire(sweep_guard_core::Time /*now*/) { return {}; }
  /// Returns whether a message that can be read makes up for one before that could not.
  virtual bool isComplete() const = 0;
  /// Returns what is in the messages and is no workpiece, in words; empty: nothing.
  virtual std::string leftOut() const { return {}; }
  /// Forgets what later messages may build on: some may have been lost.
  virtual sweep_guard_core::SceneUpdate restart() { return {}; }
};

/// @param datatype  type of the messages
/// @throws sweep_guard_core::InvalidInput if they are of a type that is not known, naming those that are
std::unique_ptr<SceneReader> makeSceneReader(const std::string& datatype, const EnvironmentTopic& topic);

}  // namespace sweep_guard_ros
