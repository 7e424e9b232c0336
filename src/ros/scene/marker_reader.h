#pragma once

#include <map>
#include <optional>
#include <string>

#include "ros/scene/scene_reader.h"
#include "scene/welding.h"

namespace sweep_guard_ros {

/// Reads visualization_msgs/Marker and MarkerArray as rviz does: TRIANGLE_LIST, MESH_RESOURCE, CUBE, SPHERE and CYLINDER are
/// workpieces of the id NAMESPACE/NUMBER; other types are none. Lifetime, DELETE and DELETEALL end them.
class MarkerReader : public SceneReader {
 public:
  explicit MarkerReader(const EnvironmentTopic& topic) : topic_(topic) {}

  sweep_guard_core::SceneUpdate read(const MessageValue& message, sweep_guard_core::Time now) override;
  sweep_guard_core::SceneUpdate expire(sweep_guard_core::Time now) override;
  bool isComplete() const override { return false; }
  std::string leftOut() const override;

 private:
  struct Marker {
    sweep_guard_core::Time expires;  // epoch: never
    sweep_guard_core::Welding welding = {};
    std::string resource = {};  // whose surface is the next one
    sweep_guard_core::TriangleSurface surface_R = {};
    std::string unread = {};  // why it has none
  };

  void follow(const MessageValue& marker, sweep_guard_core::Time now, sweep_guard_core::SceneUpdate& update);
  void clear(sweep_guard_core::SceneUpdate& update);
  sweep_guard_core::SceneChange tooMany();
  static sweep_guard_core::TriangleSurface surfaceOf(const MessageValue& marker, std::int64_t type, Marker& known);
  static sweep_guard_core::TriangleSurface surfaceOfResource(const std::string& uri, Marker& known);

  const EnvironmentTopic topic_;
  std::map<std::string, Marker> markers_;  // by id of their workpieces
  size_t others_ = 0;                      // of other types, since the start
  bool too_many_ = false;                  // since the last DELETEALL
};

}  // namespace sweep_guard_ros
