#pragma once

#include <string>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

/// A workpiece as a file or another program describes it.
struct SceneObject {
  std::string id;             ///< not checked
  std::string frame;          ///< name of the frame M of the vertices; not checked
  Time stamp;                 ///< at which the vertices had these positions; epoch: not known
  TriangleSurface surface_M;  ///< [m]
  bool open = false;          ///< it encloses nothing
};

}  // namespace sweep_guard_core
