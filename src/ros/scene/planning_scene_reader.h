#pragma once

#include <string>

#include "ros/scene/scene_reader.h"

namespace sweep_guard_ros {

/// Reads moveit_msgs/PlanningScene and CollisionObject, of any version. A plane is the top of a floor, see floorPrimitive().
class PlanningSceneReader : public SceneReader {
 public:
  /// @param has_full_scenes  nothing counts before the first one, or after messages may have been lost
  PlanningSceneReader(const EnvironmentTopic& topic, bool has_full_scenes)
      : topic_(topic), has_full_scenes_(has_full_scenes), scene_(has_full_scenes) {}

  sweep_guard_core::SceneUpdate read(const MessageValue& message, sweep_guard_core::Time now) override;
  sweep_guard_core::SceneUpdate restart() override;
  bool isComplete() const override { return has_full_scenes_ && !needs_full_scene_; }
  std::string leftOut() const override { return has_octomap_ ? "an octomap is left out: it is no surface" : ""; }

 private:
  const EnvironmentTopic topic_;
  const bool has_full_scenes_;
  sweep_guard_core::PlanningScene scene_;
  bool needs_full_scene_ = false;
  bool has_octomap_ = false;

  sweep_guard_core::SceneUpdate apply(sweep_guard_core::PlanningSceneMessage message);
};

}  // namespace sweep_guard_ros
