#pragma once

#include <optional>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// Surface of a workpiece as seen from above (along -z of the fixed frame W).
class TopSurface {
 public:
  /// @param mesh_W  the workpiece; its frame M is W
  explicit TopSurface(sweep_guard_core::TriangleMesh mesh_W);

  const Eigen::Vector3d& highestPoint() const { return highest_W_; }  ///< [m], of the triangles
  std::optional<double> height(double x, double y) const;             ///< [m] at (x, y); empty: no surface there

 private:
  sweep_guard_core::TriangleMesh mesh_W_;
  Eigen::Vector3d highest_W_;
};

}  // namespace sweep_guard_simulation
