#pragma once

#include <string>

#include "ros/scene/message_value.h"
#include "ros/scene/scene_reader.h"

namespace sweep_guard_ros {

/// Reads one workpiece from a message; its id is that of the topic.
/// @throws sweep_guard_core::InvalidInput
using ReadSingleMesh = sweep_guard_core::SceneObject (*)(const MessageValue& message, const EnvironmentTopic& topic);

sweep_guard_core::SceneObject readShapeMesh(const MessageValue& message,
                                            const EnvironmentTopic& topic);  ///< shape_msgs/Mesh
sweep_guard_core::SceneObject readPolygonMesh(const MessageValue& message,
                                              const EnvironmentTopic& topic);  ///< pcl_msgs/PolygonMesh
sweep_guard_core::SceneObject readMeshGeometry(const MessageValue& message,
                                               const EnvironmentTopic& topic);  ///< mesh_msgs/MeshGeometryStamped
sweep_guard_core::SceneObject readTriangleMesh(const MessageValue& message,
                                               const EnvironmentTopic& topic);  ///< mesh_msgs/TriangleMeshStamped

}  // namespace sweep_guard_ros
