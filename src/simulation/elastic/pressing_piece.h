#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "interaction/piece_polytope.h"
#include "simulation/elastic/bar_model.h"
#include "sweep_guard/interaction/interaction_finder.h"

namespace sweep_guard_simulation {

/// A convex piece of a tool that presses on the vertices of a mesh. The sum of the pressures is the interaction force.
/// As with an elastic layer, the pressure at a point of the surface is proportional to its depth in the piece, measured
/// against the force; it is summed over points of the triangles and shared between their corners.
class PressingPiece {
 public:
  /// @param law  its damping is left out
  PressingPiece(const sweep_guard_core::ConvexShape& shape_T, const sweep_guard_core::ForceLaw& law);

  /// Appends the pressures on the vertices of a mesh, which are its nodes.
  void press(const sweep_guard_core::TriangleMesh& mesh_M, const Eigen::Isometry3d& X_MT,
             std::vector<Pressure>& pressures);

 private:
  double depth(const Eigen::Vector3d& p_T, const Eigen::Vector3d& outward_T) const;

  sweep_guard_core::InterpenetrationFinder finder_;
  sweep_guard_core::PiecePolytope polytope_;
  double radius_;   // of a ball around the polytope's center that holds it [m]
  double spacing_;  // of the points, at most [m]
  sweep_guard_core::ForceLaw law_;
};

}  // namespace sweep_guard_simulation
