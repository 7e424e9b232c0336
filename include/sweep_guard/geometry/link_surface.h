#pragma once

#include <string>
#include <vector>

#include "sweep_guard/geometry/tool.h"

namespace sweep_guard_core {

/// A surface around one link of a body, for those who test against it.
struct LinkSurface {
  std::string link;                         ///< empty for a tool without a robot description
  std::vector<Eigen::Vector3d> vertices_B;  ///< [m]
  std::vector<Triangle> triangles;          ///< of each convex piece: a closed surface, counter-clockwise from outside
};

/// Returns surfaces around the links of a body, in the order in which its pieces name them. Each surface encloses its
/// convex piece, padding and roundness included, at a distance of at least 0.01 mm, and is nowhere farther from it than
/// 1.3 times the distance by which ConvexShape::mesh_T() falls short of it.
/// @throws InvalidInput if a piece reaches to kMaxCoordinate
/// @throws DeviceError as convexHull()
std::vector<LinkSurface> linkSurfaces(const Tool& body_B);

}  // namespace sweep_guard_core
