#pragma once

#include <Eigen/Core>

#include "sweep_guard/geometry/mesh_order.h"

namespace sweep_guard_core {

// Closed surfaces [m], counter-clockwise seen from outside. The center of their bounding box is the origin, and their
// axis is z, as in shape_msgs/SolidPrimitive. Round ones contain the whole shape, up to rounding. Each function throws
// InvalidInput naming the dimension that is not above 0 and at most 1000 m.

/// Bounds how far the surface of a round shape reaches beyond the shape, relative to its radius: 0.97 % for a sphere,
/// 0.49 % for a cylinder and a cone.
constexpr double kPrimitiveDeviation = 0.01;

TriangleSurface boxPrimitive(const Eigen::Vector3d& size);
TriangleSurface cylinderPrimitive(double radius, double height);
/// The tip points along +z.
TriangleSurface conePrimitive(double radius, double height);
TriangleSurface spherePrimitive(double radius);

/// Returns a box of 20 x 20 x 1 m whose top is at z = 0.
TriangleSurface floorPrimitive();

}  // namespace sweep_guard_core
