#pragma once

#include <Eigen/Core>

#include "guard/displacements.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/triangle_mesh.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// A mesh that may have moved from one deformation to the next while the tool moved: each vertex straight and at any
/// speed, up to `path_deviation`. Both meshes must outlive it.
class MovingMesh {
 public:
  /// Makes a mesh at rest.
  MovingMesh(const TriangleMesh& mesh_M) : mesh_M_(mesh_M) {}  // NOLINT(google-explicit-constructor)

  /// @param before_M        the earlier deformation, with the same triangles
  /// @param displacements   from before_M to mesh_M
  /// @param path_deviation  upper bound on the distance of a vertex from its straight path [m], >= 0
  MovingMesh(const TriangleMesh& mesh_M, const TriangleMesh& before_M, const Displacements& displacements,
             double path_deviation);

  /// Makes a grid on the way from where its vertices were before. It is not translated: its submesh() is all that it may have met.
  static MovingMesh grid(const TriangleMesh& mesh_M);

  const TriangleMesh& mesh_M() const { return mesh_M_; }           ///< the later deformation
  bool moved() const { return is_grid_ || before_M_ != nullptr; }  ///< some vertex has moved
  Submesh submesh() const { return is_grid_ ? Submesh::inMotion(mesh_M_) : Submesh(mesh_M_); }
  const Eigen::Vector3d& translation_M() const { return translation_M_; }  ///< translation of the mesh as a whole [m]
  /// Returns an upper bound on the distance of a vertex, at any time, from where the translation alone would put it
  /// [m], plus its margin. A volume that is extended by the translation and grown by this meets all that the moving mesh
  /// meets.
  double spread() const { return spread_; }
  /// Returns an upper bound on the distance of a corner from triangle() [m], plus the margin of the mesh.
  double uncertainty() const { return uncertainty_; }

  MovingTriangle triangle(std::uint32_t index) const;
  /// Returns what of a triangle the translation leaves: of a grid its way, else where it is in the later deformation.
  MovingTriangle untranslated(std::uint32_t index) const;

 private:
  const TriangleMesh& mesh_M_;
  const TriangleMesh* before_M_ = nullptr;
  bool is_grid_ = false;
  Eigen::Vector3d translation_M_ = Eigen::Vector3d::Zero();
  double spread_ = mesh_M_.margin();
  double uncertainty_ = mesh_M_.margin();
};

/// Returns the mesh of a workpiece on the way from one deformation to another. Where updates between them were not kept, a vertex
/// may have left its straight path.
/// @param displacements  from `before` to `now`
MovingMesh movingMesh(const Workpiece& now, const Workpiece& before, const Displacements& displacements);

/// Returns an upper bound on the distance of a vertex from its straight path [m].
/// @param path_length   upper bound on the length of the vertex's path [m]
/// @param displacement  lower bound on the distance between the ends of the path [m]
double pathDeviation(double path_length, double displacement);

}  // namespace sweep_guard_core
