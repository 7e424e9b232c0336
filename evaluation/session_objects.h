#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/recorded_motion.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_evaluation {

struct SessionOptions {
  size_t sheets = 20;                                  ///< in each session
  size_t sessions = 5;                                 ///< of each recording, each with a seed of its own
  std::uint64_t seed = 1;                              ///< of the first session; the others have the next ones
  std::vector<sweep_guard_core::TriangleMesh> placed;  ///< placed at random as the sheets are
  std::vector<sweep_guard_core::TriangleMesh> fixed;   ///< stay where their coordinates say, in W
};

/// Places the objects of a session: fixed for the whole recording.
///
/// Sheets are squares with sides of 0.1 to 0.3 m, uniformly distributed. The center of each sheet, or of the box around a
/// placed mesh, is uniformly distributed in a ball of 0.2 m around the tool's origin at a random time; its orientation is
/// uniformly distributed, too.
///
/// @param session  number, from 0
/// @return the sheets, then the placed meshes, then the fixed ones, in W
std::vector<sweep_guard_core::TriangleMesh> placeInWorkspace(const RecordedMotion& motion,
                                                             const SessionOptions& options, size_t session);

}  // namespace sweep_guard_evaluation
