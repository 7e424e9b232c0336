#pragma once

#include <cstdint>

#include "guard/moving_mesh.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// One convex body of the tool during one motion, and the volume that holds it. The body must outlive this struct.
struct SweptBody {
  const ConvexShape* shape_T;
  Motion motion_M;
  VolumeKind kind;
  SweptVolume volume_M;
};

/// Computes the volume that a body sweeps.
/// @param margin  the body is grown by this [m], >= 0
SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin);

/// Returns whether a body is proven to miss a triangle by the margin of its volume and a growth [m], whatever the volume: to miss
/// the hull of the body at both ends of the motion, before and after its mesh_translation.
bool misses(const SweptBody& body, const MovingTriangle& triangle, double growth = 0.0);

/// If the volume is `hull`, removes what the body misses() by the inflation from what a detector found; otherwise the volume
/// decides alone.
void removeMissedByHull(const SweptBody& body, const MovingMesh& mesh, Detection& detection);

/// Returns whether a direction proves that a body is farther than `margin` [m] from a triangle: from the hull of the
/// triangle before and after its motion, with the body anywhere in the hull of its motion's two poses before and after
/// its mesh_translation.
/// @param guess_M  direction from the triangle to the body that may prove it, of any length; zero for none
bool missedByHull(const ConvexShape& shape_T, const Motion& motion_M, const MovingTriangle& triangle, double margin,
                  const Eigen::Vector3d& guess_M = Eigen::Vector3d::Zero());

}  // namespace sweep_guard_core
