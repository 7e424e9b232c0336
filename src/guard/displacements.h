#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/guard/workpiece.h"

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

/// Keeps the displacements between deformations, so that the bodies of a tool, and its next sweeps, share one pass over the
/// vertices. Keeps its buffer.
class DisplacementCache {
 public:
  /// Returns the displacements from one deformation of a workpiece to another one, with the same triangles.
  Displacements between(const std::shared_ptr<const Workpiece>& from, const std::shared_ptr<const Workpiece>& to);

  /// Forgets the deformations that between() was not asked for since the last call.
  void forgetUnused();

 private:
  struct Known {
    std::shared_ptr<const Workpiece> from;
    std::shared_ptr<const Workpiece> to;
    Displacements displacements;
    bool used;
  };

  std::vector<Known> known_;
};

}  // namespace sweep_guard_core
