#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "motion/facing.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {

// The planes of a Proximity count what stands behind each: the speed of its surface, its displacement since its last
// update, and in contact its depth.

/// Adds the plane of a triangle. The facing's cover knows it from now on, unless the piece reaches through it: such a
/// plane separates the piece from nothing, and triangles join it one by one.
void addFacingPlane(Facing& facing, const SeparatedTriangle& separated, std::vector<ProximityPlane>& planes);

/// Lets a triangle in contact join the plane of the most similar normal, within 26 degrees. Returns false without one.
bool joinFacingPlane(const Facing& facing, const SeparatedTriangle& separated, std::vector<ProximityPlane>& planes);

/// Moves a plane to the tool [m].
inline void moveOn(SeparatingPlane& plane, double step) {
  plane.gap -= step;
  plane.point_W += step * plane.normal_W;
}

/// Counts the speed of a part that the plane stands for, as SurfaceMotion::alongNormal() takes it.
template <typename... Part>
void quicken(SeparatingPlane& plane, const Facing& facing, const Part&... part) {
  const SurfaceMotion& motion = *facing.surface->motion;
  const Eigen::Vector3d normal_T = facing.body->X_WT.linear().transpose() * plane.normal_W;
  const Eigen::Vector3d n_M = facing.cover.normal_M(normal_T);
  const double before = plane.surface_speed;
  plane.surface_speed = std::max(before, motion.moves() ? motion.alongNormal(n_M, part...) : 0.0);
  moveOn(plane, facing.surface->age * (std::max(0.0, plane.surface_speed) - std::max(0.0, before)));
}

}  // namespace sweep_guard_core
