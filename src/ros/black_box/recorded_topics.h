#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <string>
#include <vector>

#include "ros/black_box/black_box_parameters.h"

namespace sweep_guard_ros {

/// Which of the messages from before a recording belong to it: of each kind only the newest.
enum class KeptMessages {
  kNone,
  kNewest,         ///< of each publisher
  kEachMesh,       ///< DeformableMesh: the newest of each workpiece
  kEachVertices,   ///< MeshVertices: the newest of each workpiece that is newer than its mesh
  kEachTransform,  ///< TFMessage: the newest with the same child frames
};

/// A topic that the guard hears or publishes.
struct RecordedTopic {
  std::string topic;     ///< as it is subscribed to
  std::string recorded;  ///< name in the bag: as replay.launch plays and a guard with the default name publishes it
  KeptMessages kept = KeptMessages::kNone;
  std::uint32_t queue_length = 2000;  ///< messages
};

/// Returns the inputs of the guard by the names that remappings of the node give them, and its outputs, but for ~markers and
/// ~view, which draw what the others say, and ~surface and ~bodies, which are for the guards of other tools.
std::vector<RecordedTopic> recordedTopics(const ros::NodeHandle& node, const BlackBoxParameters& parameters);

constexpr const char* kRecordedWarning = "/sweep_guard/warning";

}  // namespace sweep_guard_ros
