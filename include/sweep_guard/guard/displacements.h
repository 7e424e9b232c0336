#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// How far the vertices of a mesh have gone from one deformation to another: a box that holds the displacement of each,
/// along the axes of M [m].
class Displacements {
 public:
  /// None has moved.
  Displacements() = default;
  /// One pass over the positions of both. What rounding costs is part of the box.
  /// @param to_M  of the same triangles
  Displacements(const TriangleMesh& from_M, const TriangleMesh& to_M);

  const Eigen::AlignedBox3d& box_M() const { return box_M_; }
  bool any() const { return !box_M_.min().isZero(0.0) || !box_M_.max().isZero(0.0); }  ///< some vertex has moved
  /// No vertex has gone farther than this [m].
  double farthest() const { return box_M_.min().cwiseAbs().cwiseMax(box_M_.max().cwiseAbs()).norm(); }
  /// Every vertex has gone at least this far [m].
  double least() const { return box_M_.exteriorDistance(Eigen::Vector3d::Zero().eval()); }

 private:
  Eigen::AlignedBox3d box_M_ = Eigen::AlignedBox3d(Eigen::Vector3d::Zero());
};

}  // namespace sweep_guard_core
