#pragma once

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_evaluation {

/// A flat square surface that the tool may run into. Frame S: origin at its centre, x and y along its sides.
struct SquareObstacle {
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  double half_side = 0.1;  ///< [m], > 0
};

/// Two triangles, in W.
sweep_guard_core::TriangleMesh meshOf(const SquareObstacle& obstacle);

/// Whether a tool meets a obstacle, in closed form and without the guard's boxes: the obstacle is clipped to the slab between
/// the ends of the round cylinder, and what is left has a point within the radius of the axis, or has not.
/// @param margin  grows the cylinder by so much in radius and at both ends [m], >= 0; a obstacle that is nearer than this
/// to
///                the tool is met, one farther than sqrt(2) times this is not
bool meets(const sweep_guard_core::ConvexShape& tool, const Eigen::Isometry3d& X_WT, const SquareObstacle& obstacle,
           double margin);

}  // namespace sweep_guard_evaluation
