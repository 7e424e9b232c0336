#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// A box with its own axes. Frame B has its origin at the centre; Z is the axis of the length, Y of the width, X of the
/// height [P, Sec. 3.1, Fig. 4].
struct OrientedBox {
  Eigen::Isometry3d X_MB = Eigen::Isometry3d::Identity();  ///< rotation orthonormal, translation [m]
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< along X, Y, Z of B [m]; >= 0, ascending
};

/// The box of [P, Sec. 3.1] around a body of the tool at both ends of a motion, before and after its mesh_translation: its axes
/// are the eigenvectors of the covariance of the corners of the body's triangles there [Gottschalk et al. 1996], its
/// extents those of the body itself, so that it holds every point of it. Always a valid box: without motion, for a flat
/// body, for equal eigenvalues. It does not hold the arcs between the poses; chordError() says what they need.
OrientedBox boundingBox(const ConvexShape& shape, const Motion& motion);

}  // namespace sweep_guard_core
