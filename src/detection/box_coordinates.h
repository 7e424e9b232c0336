#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/oriented_box.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Transforms the vertices of a mesh to the frame B of a box, in double. Subtracts the center before it rotates, so
/// that a workpiece far from its frame's origin loses no digits, and coordinates are small before they are rounded to
/// float32.
class BoxCoordinates {
 public:
  BoxCoordinates(const TriangleMesh& mesh_M, const OrientedBox& box_M)
      : mesh_(mesh_M), R_BM_(box_M.X_MB.linear().transpose()), center_(box_M.X_MB.translation() - mesh_M.origin()) {
    const double largest =
        box_M.X_MB.translation().norm() + box_M.half_extents.norm() + mesh_M.origin().norm() + mesh_M.radius();
    rounding_ = largest * 0x1p-48;
  }

  /// Returns the position of a vertex in B [m].
  Eigen::Vector3d position(std::uint32_t vertex) const { return R_BM_ * (mesh_.offset(vertex) - center_); }

  /// Returns the position of the mesh's origin in B [m].
  Eigen::Vector3d origin() const { return R_BM_ * -center_; }

  /// Returns a bound [m] on the rounding of these positions, of the box, and of points that clipping computes between
  /// them: a dozen roundings of 2^-53, with a reserve.
  double rounding() const { return rounding_; }

 private:
  const TriangleMesh& mesh_;
  Eigen::Matrix3d R_BM_;
  Eigen::Vector3d center_;
  double rounding_;
};

}  // namespace sweep_guard_core
