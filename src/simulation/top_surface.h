#pragma once

#include <optional>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_simulation {

/// What one sees of a workpiece from above (along -z of the fixed frame W): where a tool that comes from there meets
/// it.
class TopSurface {
 public:
  /// @param mesh_W  the workpiece, its frame M being W
  explicit TopSurface(sweep_guard_core::TriangleMesh mesh_W);

  const Eigen::Vector3d& highestPoint() const { return highest_W_; }  ///< [m], of the triangles
  std::optional<double> height(double x, double y) const;  ///< [m] of the surface over (x, y), empty beside it

 private:
  sweep_guard_core::TriangleMesh mesh_W_;
  Eigen::Vector3d highest_W_;
};

}  // namespace sweep_guard_simulation
