#pragma once

#include <ros/node_handle.h>

#include <cstddef>
#include <string>
#include <vector>

#include "session/session_files.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_session {

constexpr const char* kStaticTransformsTopic = "/tf_static";
constexpr const char* kIntendTopic = "/sweep_guard/intend_updates";

/// Topics of a depth camera that is a workpiece.
struct SessionCamera {
  std::string id;
  std::string depth;  ///< sensor_msgs/Image, or CompressedImage if it ends in /compressedDepth
  std::string info;   ///< sensor_msgs/CameraInfo
};

/// Topics of the guard's inputs. The bag may name them without a slash at their front.
struct SessionTopics {
  std::string tool_pose;              ///< geometry_msgs/PoseStamped; empty: the pose comes from elsewhere
  std::string mesh;                   ///< sweep_guard/DeformableMesh; empty: the workpiece comes from elsewhere
  std::string mesh_vertices;          ///< sweep_guard/MeshVertices; may be missing in the bag
  std::string joint_states;           ///< sensor_msgs/JointState; empty: the tool has no joints that move
  std::vector<std::string> frames{};  ///< of the tool, which tf has to place
  std::string fixed_frame = "world";  ///< needs no transform
  std::vector<SessionCamera> cameras{};
};

/// Summary of a session.
struct SessionBag {
  std::vector<sweep_guard_core::Time> poses;  ///< stamps of the poses that are played, ascending
  std::size_t meshes = 0;                     ///< number of mesh messages
  std::size_t vertices = 0;                   ///< number of vertex messages
  std::vector<std::string> cameras{};         ///< id of each and number of its images, in words
  sweep_guard_core::Time begin;               ///< first message
  sweep_guard_core::Time start;               ///< it is played from here on
  sweep_guard_core::Time end;                 ///< last message
  std::vector<std::string> missing{};         ///< what the guard will lack, and what to do, in words
  std::vector<std::string> config{};          ///< describeConfig()
};

/// Returns the cameras that a guard has in its parameters.
/// @throws sweep_guard_core::InvalidInput as sweep_guard_ros::readCameras()
std::vector<SessionCamera> camerasOf(const ros::NodeHandle& guard);

/// Checks a recorded session before it is played.
/// @param start  after the first message; it is played from there on; >= 0
/// @throws sweep_guard_core::InvalidInput that says what is wrong and what to do: a topic is missing or has another type (the
///     message lists the topics), or one that is played has another version of its type; poses have no stamps, or stamps from another clock than the recorder's; the session
///     ends before the start; or a file is broken
SessionBag inspectSession(const SessionFiles& files, const SessionTopics& topics,
                          sweep_guard_core::Duration start = sweep_guard_core::Duration(0));

}  // namespace sweep_guard_session
