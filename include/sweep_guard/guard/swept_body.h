#pragma once

#include "sweep_guard/detection/detector.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/convex_shape.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/swept_volume.h"

namespace sweep_guard_core {

/// One convex body of the tool during one motion, and the volume that holds it. The body must outlive it.
struct SweptBody {
  const ConvexShape* shape_T;
  Motion motion_M;
  VolumeKind kind;
  SweptVolume volume_M;
};

/// @param margin  the body is grown by this [m], >= 0
SweptBody sweptBody(const ConvexShape& shape_T, const Motion& motion_M, VolumeKind kind, double margin);

/// The triangles that the volume meets; of kind `hull`, those of them that the hull of the body at both ends of the
/// motion, before and after its mesh_translation, grown by the volume's margin, is not proven to miss.
/// @param[out] found  what was in it is replaced
/// @throws DeviceError if the detector fails
void detect(Detector& detector, const Submesh& part, const SweptBody& body, Detection& found);

/// Whether a direction proves that a body, anywhere in the hull of its motion's two poses before and after its mesh_translation,
/// is farther than `margin` [m] from a triangle, anywhere in the hull of its two places.
bool missedByHull(const ConvexShape& shape_T, const Motion& motion_M, const MovingTriangle& triangle, double margin);

}  // namespace sweep_guard_core
