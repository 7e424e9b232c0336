#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"

namespace sweep_guard_session {

/// Topics of the guard's inputs, as they are named in the bag.
struct SessionTopics {
  std::string tool_pose;      ///< geometry_msgs/PoseStamped; empty: the pose comes from elsewhere
  std::string mesh;           ///< sweep_guard/DeformableMesh; empty: the workpiece comes from elsewhere
  std::string mesh_vertices;  ///< sweep_guard/MeshVertices; may be missing in the bag
  std::string joint_states;   ///< sensor_msgs/JointState; empty: the tool has no joints that move
};

/// Summary of a bag.
struct SessionBag {
  std::vector<sweep_guard_core::Time> poses;  ///< stamps of the poses, ascending
  std::size_t meshes = 0;                     ///< number of mesh messages
  std::size_t vertices = 0;                   ///< number of vertex messages
  sweep_guard_core::Time begin;               ///< first message
  sweep_guard_core::Time end;                 ///< last message
};

/// Checks a recorded session before it is played.
/// @throws sweep_guard_core::InvalidInput that says what is wrong and what to do: the file is missing, not regular, no
///     bag, without index, broken, or empty; a topic is missing or has another type (the message lists the topics);
///     poses have no stamps, or stamps from another clock than the recorder's
SessionBag inspectBag(const std::string& path, const SessionTopics& topics);

}  // namespace sweep_guard_session
