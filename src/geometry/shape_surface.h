#pragma once

#include <Eigen/Core>
#include <array>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

// Surfaces of bodies, each in its own frame [m].

/// Returns a prism inside a cylinder around the z axis, with z in [-length, 0].
/// @param sides  >= 3
TriangleSurface cylinderSurface(double radius, double length, int sides);
/// Returns a polyhedron inside a sphere around the origin.
TriangleSurface sphereSurface(double radius);
TriangleSurface boxSurface(const Eigen::Vector3d& half_extents);

/// Returns the corners of a box around the origin: corner i is on the positive side of axis k if bit k of i is set.
std::array<Eigen::Vector3d, 8> boxCorners(const Eigen::Vector3d& half_extents);

}  // namespace sweep_guard_core
