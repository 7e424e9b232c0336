#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_session {

/// What a session is guarded from. The names are those of the bag.
struct SessionTopics {
  std::string tool_pose;      ///< geometry_msgs/PoseStamped; empty: the pose comes from tf
  std::string mesh;           ///< sweep_guard/DeformableMesh; empty: the workpiece comes from elsewhere
  std::string mesh_vertices;  ///< sweep_guard/MeshVertices; may be missing in the bag
};

/// A bag that can be guarded.
struct SessionBag {
  std::vector<sweep_guard_core::Time> poses;  ///< stamps of the messages on the pose's topic, ascending
  std::size_t meshes = 0;                     ///< messages on the mesh's topic
  std::size_t vertices = 0;                   ///< messages on the topic of its vertices
  sweep_guard_core::Time begin;               ///< first message
  sweep_guard_core::Time end;                 ///< last message
};

/// Looks into a recorded session before it is played.
/// @throws sweep_guard_core::InvalidInput that says what is wrong and what to do: no such file, no regular file, no bag,
///     without index, broken, empty; a topic that is not in it or has another type (those that are there are listed);
///     poses without stamps, or whose stamps are from another clock than the one that recorded them
SessionBag inspectBag(const std::string& path, const SessionTopics& topics);

}  // namespace sweep_guard_session
