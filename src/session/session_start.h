#pragma once

#include <sweep_guard/DeformableMesh.h>
#include <sweep_guard/Intend.h>
#include <sweep_guard/MeshVertices.h>
#include <tf2_msgs/TFMessage.h>

#include <vector>

#include "session/session_bag.h"
#include "session/session_files.h"

namespace sweep_guard_session {

/// What a guard knows when a session is played from a later time on: messages that were recorded before and still count.
struct SessionStart {
  std::vector<sweep_guard::DeformableMesh::ConstPtr> meshes;  ///< the newest of each workpiece that was not removed
  std::vector<sweep_guard::MeshVertices::ConstPtr> vertices;  ///< the newest of each of these
  std::vector<tf2_msgs::TFMessage::ConstPtr> transforms;  ///< one with the newest static ones; none if there are none
  std::vector<sweep_guard::Intend::ConstPtr> intends;     ///< those not taken back; durations count from the start
};

/// Reads the messages that were recorded before `start`.
/// @throws sweep_guard_core::InvalidInput if a file is broken
SessionStart readStart(const SessionFiles& files, const SessionTopics& topics, sweep_guard_core::Time start);

}  // namespace sweep_guard_session
