#pragma once

#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/half_space.h"
#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_evaluation {

/// A flat square. Frame S: origin at the center, x and y along the sides.
struct SquareObstacle {
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  double half_side = 0.1;  ///< [m], > 0
};

/// Returns the square as two triangles in W.
sweep_guard_core::TriangleMesh meshOf(const SquareObstacle& obstacle);

/// Returns whether a round cylinder intersects a convex polygon. Computed in closed form, independently of the guard:
/// clips the polygon to the slab between the ends of the cylinder, and compares its distance from the axis with the
/// radius.
/// @param tool       a cylinder
/// @param polygon_T  corners in the tool frame [m]
/// @param margin     grows radius and both ends of the cylinder [m], >= 0. Polygons closer to the tool than `margin`
///                   intersect, those farther than sqrt(2) * `margin` do not.
bool intersects(const sweep_guard_core::ConvexShape& tool, sweep_guard_core::Polygon polygon_T, double margin);

/// Does the same for an obstacle and a pose of the tool.
bool intersects(const sweep_guard_core::ConvexShape& tool, const Eigen::Isometry3d& X_WT,
                const SquareObstacle& obstacle, double margin);

}  // namespace sweep_guard_evaluation
