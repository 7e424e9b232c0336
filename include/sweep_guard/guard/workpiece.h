#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// One workpiece as it was at a moment. Handed around as a shared snapshot, so that a new deformation never waits for a
/// sweep.
struct Workpiece {
  std::string id;
  std::uint32_t revision = 0;  ///< counts changes of the triangles
  Time stamp;                  ///< of the vertex positions
  SteadyTime received;
  std::string frame;  ///< name of the mesh's frame M
  TriangleMesh mesh_M;
  std::uint64_t updates = 0;  ///< of the positions of these triangles, so far
  double path_length = 0.0;   ///< in these, no vertex has gone farther in all [m]
};
using Workpieces = std::vector<std::shared_ptr<const Workpiece>>;

/// A workpiece that could not be swept, and why.
struct SweepFailure {
  std::shared_ptr<const Workpiece> workpiece;
  std::string reason;
};

}  // namespace sweep_guard_core
