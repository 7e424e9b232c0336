#pragma once

#include <array>

#include "evaluation/first_contact.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_evaluation {

/// Beyond this, distances from an obstacle are not exact [m].
constexpr double kExactDistance = 0.05;

/// Measures where a cylinder is relative to a fixed mesh. A tool whose tip is inside a closed mesh is in contact.
class ObstacleMesh {
 public:
  /// @param tool    a cylinder; must outlive this object, as must the mesh
  ObstacleMesh(const sweep_guard_core::ConvexShape& tool, const sweep_guard_core::TriangleMesh& mesh_W);

  const sweep_guard_core::ConvexShape& tool() const { return tool_; }

  /// Returns the clearance for firstContact(), in closed form. This object must outlive it.
  ClearanceAt clearance();

  /// Returns the distance of the tool at a pose [m], to 1e-5 m; 0 in contact. Beyond kExactDistance, returns a lower
  /// bound that is no smaller.
  double distance(const Eigen::Isometry3d& X_WT);

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  bool intersects(const Eigen::Isometry3d& X_WT, double margin);
  bool tipInside(const Eigen::Isometry3d& X_WT) const;
  template <typename Function>
  void forEachTriangleWithin(double margin, const Eigen::Isometry3d& X_WT, const Function& function);

  const sweep_guard_core::ConvexShape& tool_;
  const sweep_guard_core::TriangleMesh& mesh_W_;
  Eigen::AlignedBox3d bounds_W_;
  sweep_guard_core::SubmeshFinder finder_;
};

}  // namespace sweep_guard_evaluation
