#pragma once

#include <Eigen/Core>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// A convex hull of points, in their frame. TriangleMesh(corners, triangles) is its surface, rounded to float32.
struct ConvexHull {
  std::vector<Eigen::Vector3d> corners;  ///< those points that are corners, exact, each once [m]
  std::vector<Triangle> triangles;       ///< at least one; counter-clockwise seen from outside if `solid`
  double hull_tolerance = 0.0;           ///< bound on the distance of any point from the hull of the corners [m], >= 0
  bool solid = false;                    ///< the triangles enclose a volume; false for flat hulls and if Qhull failed
};

/// Computes the convex hull by Qhull [Barber et al. 1996]. Any threads may call it at once.
///
/// Qhull omits points that it cannot distinguish from its facets. `hull_tolerance` bounds their distance by comparison
/// with convex combinations of corners, so the bound does not rely on Qhull. It is mostly about one rounding for each
/// corner, and at most 1e-9 of the largest distance of a point from the center of the box around all points; if it
/// would be larger, Qhull counts as failed.
///
/// Points in a plane, on a line or at one place have a hull without volume, represented by a fan of triangles; these
/// are degenerate on a line and at one place. If Qhull fails, every point is a corner, hull_tolerance is 0 and
/// `solid` is false; the triangles then touch every corner, but are not the surface.
/// @param points  [m], at least one; finite and within kMaxCoordinate
/// @throws InvalidInput if there is no point, or naming the index of the first unusable point
/// @throws DeviceError if /dev/null cannot be opened
ConvexHull convexHull(const std::vector<Eigen::Vector3d>& points);

/// Returns the volume [m^3] of a hull; 0 if it is not solid.
double volume(const ConvexHull& hull);

/// Returns the surface area [m^2] of a hull; both sides of a flat hull count. Means nothing if Qhull failed.
double surface(const ConvexHull& hull);

}  // namespace sweep_guard_core
