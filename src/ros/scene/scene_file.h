#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ros/scene/environment_topic.h"
#include "scene/scene_object.h"

namespace sweep_guard_ros {

/// Workpieces, and topics that describe others.
struct Scene {
  std::vector<sweep_guard_core::SceneObject> objects;  ///< each id once
  std::vector<EnvironmentTopic> topics;                ///< each once
};

/// Reads a scene: a YAML group of groups, by the ids of the workpieces, as in
///
///     table: {box: [1.2, 0.8, 0.05], frame: base_link, position: [0.6, 0.0, -0.025]}
///     environment: [{topic: /move_group/monitored_planning_scene}]
///
/// Each has one shape: `box: [x, y, z]`, `cylinder: [radius, height]` along z, `sphere: radius`, `floor: z` (a box of 20 x
/// 20 x 1 m whose top is at z) or `mesh: FILE`, all in m, centered at their origin; a mesh as its file has it, times `scale`
/// (a number, or one for each axis). FILE is a path, also from the folder of the scene, or a URI as in locateMesh(). Its place is `position` [m]
/// and `rpy` [rad] in `frame` (`world` if it is not given). `open: true` says that a mesh encloses nothing.
/// `environment` is no id, but a list of topics: each has a `topic`, and maybe `id`, `frame`, `namespaces` (a list), `hold` and
/// `stream` (flags), and `service`, see EnvironmentTopic.
/// @param scene  path of the file, or the YAML itself, which then begins with {
/// @throws sweep_guard_core::InvalidInput naming file, line and what is wrong; sweep_guard_core::DeviceError as readMesh()
Scene readScene(const std::string& scene);

}  // namespace sweep_guard_ros
