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

/// Tells which of the triangles that a detector names for a swept body the body misses, on a mesh at rest: those that are proven
/// to miss the hull of the body at both ends of the motion, before and after its mesh_translation, grown by the volume's margin.
class HullFilter {
 public:
  /// @param body, mesh_M  must outlive this
  /// @param inflation     of the detection [m]
  HullFilter(const SweptBody& body, const TriangleMesh& mesh_M, double inflation)
      : body_(body), mesh_M_(mesh_M), inflation_(inflation) {}

  /// Returns whether the volume is `hull` and the body is proven to miss a triangle by the margin and the inflation.
  bool leavesOut(std::uint32_t triangle) const { return filters() && misses(triangle, inflation_); }
  void removeLeftOut(TriangleSet& triangles) const;  ///< removes those that leavesOut()
  /// Returns whether the body is proven to miss a triangle by its margin, whatever the volume.
  bool bodyMisses(std::uint32_t triangle) const { return misses(triangle, 0.0); }

 private:
  bool filters() const { return body_.kind == VolumeKind::kHull; }  // otherwise the volume decides alone
  bool misses(std::uint32_t triangle, double growth) const;

  const SweptBody& body_;
  MovingMesh mesh_M_;
  double inflation_;
};

/// Returns whether a direction proves that a body is farther than `margin` [m] from a triangle: from the hull of the
/// triangle before and after its motion, with the body anywhere in the hull of its motion's two poses before and after
/// its mesh_translation.
/// @param guess_M  direction from the triangle to the body that may prove it, of any length; zero for none
bool missedByHull(const ConvexShape& shape_T, const Motion& motion_M, const MovingTriangle& triangle, double margin,
                  const Eigen::Vector3d& guess_M = Eigen::Vector3d::Zero());

}  // namespace sweep_guard_core
