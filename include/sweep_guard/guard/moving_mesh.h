#pragma once

#include <Eigen/Core>

#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/guard/displacements.h"

namespace sweep_guard_core {

/// A mesh that may have gone from one deformation to the next while the tool moved: each vertex straight, at whatever
/// pace, but for `path_deviation`. Both meshes must outlive it.
class MovingMesh {
 public:
  /// A mesh that rests.
  MovingMesh(const TriangleMesh& mesh_M) : mesh_M_(mesh_M) {}  // NOLINT(google-explicit-constructor)

  /// @param before_M       of the same triangles
  /// @param displacements  from there
  /// @param path_deviation        bound on how far a vertex was off the straight way from there [m], >= 0
  MovingMesh(const TriangleMesh& mesh_M, const TriangleMesh& before_M, const Displacements& displacements,
             double path_deviation);

  const TriangleMesh& mesh_M() const { return mesh_M_; }                   ///< where it is now
  bool moved() const { return before_M_ != nullptr; }                      ///< some vertex has
  const Eigen::Vector3d& translation_M() const { return translation_M_; }  ///< how far the mesh as a whole has gone [m]
  /// Bound on how far a vertex was, at any time, from where the mesh_translation alone would have it [m]; and what rounding of the
  /// vertices adds. A volume grown by this, and by the mesh_translation, meets what it would have met on the way.
  double spread() const { return spread_; }
  /// Bound on how far a corner was off triangle() [m], rounding included.
  double uncertainty() const { return uncertainty_; }

  MovingTriangle triangle(std::uint32_t index) const;

 private:
  const TriangleMesh& mesh_M_;
  const TriangleMesh* before_M_ = nullptr;
  Eigen::Vector3d translation_M_ = Eigen::Vector3d::Zero();
  double spread_ = mesh_M_.rounding();
  double uncertainty_ = mesh_M_.rounding();
};

/// How far a vertex can have been off the straight way [m], if it has gone `way` in all, to end `straight` from where
/// it began: half of what is left, across.
double pathDeviation(double way, double straight);

}  // namespace sweep_guard_core
