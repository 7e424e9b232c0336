#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// Bounds the displacements of a mesh's vertices from one deformation to another: a box that holds every displacement,
/// along the axes of M [m].
class Displacements {
 public:
  /// Holds no displacement.
  Displacements() = default;
  /// Computes the box in one pass over the positions of both meshes. It includes rounding errors.
  /// @param to_M  has the same triangles
  Displacements(const TriangleMesh& from_M, const TriangleMesh& to_M);

  const Eigen::AlignedBox3d& box_M() const { return box_M_; }
  bool any() const { return !box_M_.min().isZero(0.0) || !box_M_.max().isZero(0.0); }  ///< some vertex has moved
  /// Returns an upper bound on every vertex's displacement [m].
  double upperBound() const { return box_M_.min().cwiseAbs().cwiseMax(box_M_.max().cwiseAbs()).norm(); }
  /// Returns a lower bound on every vertex's displacement [m].
  double lowerBound() const { return box_M_.exteriorDistance(Eigen::Vector3d::Zero().eval()); }

 private:
  Eigen::AlignedBox3d box_M_ = Eigen::AlignedBox3d(Eigen::Vector3d::Zero());
};

}  // namespace sweep_guard_core
