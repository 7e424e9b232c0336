#pragma once

#include <Eigen/Geometry>

#include "sweep_guard/geometry/convex_shape.h"

namespace sweep_guard_core {

/// An oriented bounding box. Its frame B has its origin at the center; Z is the axis of the length, Y of the width, X
/// of the height [P, Sec. 3.1, Fig. 4].
struct OrientedBox {
  Eigen::Isometry3d X_MB = Eigen::Isometry3d::Identity();  ///< rotation orthonormal, translation [m]
  Eigen::Vector3d half_extents = Eigen::Vector3d::Zero();  ///< along X, Y, Z of B [m]; >= 0, ascending
};

/// Returns the box of [P, Sec. 3.1] around a convex body at both poses of a motion, before and after its
/// mesh_translation. The axes are the eigenvectors of the covariance of the corners of mesh_T()'s triangles there
/// [Gottschalk et al. 1996]; the extents are those of the body itself, so the box contains every point of it.
/// The box is valid without motion, for a flat body and for equal eigenvalues. It does not contain the arcs and
/// deviations between the poses; deviationBound() (swept_volume.h) bounds them.
/// @param motion  poses finite; not checked
OrientedBox boundingBox(const ConvexShape& shape, const Motion& motion);

}  // namespace sweep_guard_core
