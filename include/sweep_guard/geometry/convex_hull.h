#pragma once

#include <Eigen/Core>
#include <vector>

#include "sweep_guard/geometry/triangle_mesh.h"

namespace sweep_guard_core {

/// The convex hull of some points. TriangleMesh(corners, triangles) is its surface, rounded as meshes are.
struct ConvexHull {
  std::vector<Eigen::Vector3d> corners;  ///< some of the points, to the last digit, each once [m]
  std::vector<Triangle> triangles;       ///< counter-clockwise seen from outside; at least one
  double hull_tolerance =
      0.0;             ///< none of the points lies farther outside of the hull of the corners than this [m], >= 0
  bool solid = false;  ///< the triangles are a closed surface around a volume; flat hulls have none
};

/// The convex hull by Qhull [Barber et al. 1996]. Qhull leaves out points that it cannot tell from its facets; how much
/// that is, `hull_tolerance` says: each point is compared with a convex combination of corners, so that the bound does not rest
/// on Qhull. It is at most 1e-9 of the largest extent, a few roundings mostly.
///
/// Points in a plane, on a line or at one place have a hull without volume: a fan of triangles that has their corners;
/// degenerate ones on a line and at one place. Where Qhull gives up, every point is a corner.
/// @param points  [m], at least one; finite and within kMaxCoordinate
/// @throws InvalidInput with the index of the first that is not usable, or if there is none. Any thread.
ConvexHull convexHull(const std::vector<Eigen::Vector3d>& points);

/// Volume [m^3] of a hull; 0 if it is flat.
double volume(const ConvexHull& hull);

/// Surface [m^2] of a hull; of a flat one both of its sides.
double surface(const ConvexHull& hull);

}  // namespace sweep_guard_core
