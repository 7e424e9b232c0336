#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/oriented_box.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Takes the vertices of a mesh into the frame B of a box, in double: first the centre is subtracted, then the axes are
/// turned, so that a workpiece far from its frame's origin keeps its digits. What goes to float32 afterwards is small.
class BoxCoordinates {
 public:
  BoxCoordinates(const TriangleMesh& mesh_M, const OrientedBox& box_M)
      : mesh_(mesh_M), R_BM_(box_M.X_MB.linear().transpose()), center_(box_M.X_MB.translation() - mesh_M.origin()) {
    const double largest =
        box_M.X_MB.translation().norm() + box_M.half_extents.norm() + mesh_M.origin().norm() + mesh_M.radius();
    rounding_ = largest * 0x1p-48;
  }

  /// Position of a vertex in B [m].
  Eigen::Vector3d position(std::uint32_t vertex) const { return R_BM_ * (mesh_.offset(vertex) - center_); }

  /// Position of the mesh's origin in B [m].
  Eigen::Vector3d origin() const { return R_BM_ * -center_; }

  /// Bound [m] on the rounding of any of these positions, of the box itself, and of a point that clipping makes between
  /// them: a dozen roundings of 2^-53, with a margin.
  double rounding() const { return rounding_; }

 private:
  const TriangleMesh& mesh_;
  Eigen::Matrix3d R_BM_;
  Eigen::Vector3d center_;
  double rounding_;
};

}  // namespace sweep_guard_core
