#pragma once

#include <Eigen/Geometry>

#include "motion/facing.h"
#include "sweep_guard/motion/proximity_finder.h"

namespace sweep_guard_core {

/// Adds planes to a Proximity, and counts what stands behind each: the speed of its surface, its displacement since its
/// last update, and in contact its depth.
class PlaneCollector {
 public:
  /// @param X_WT, planes  must outlive the collector; `planes` is added to
  PlaneCollector(const Eigen::Isometry3d& X_WT, std::vector<ProximityPlane>& planes) : X_WT_(X_WT), planes_(planes) {}
  bool full() const { return planes_.size() == ProximityFinder::kMaxPlanes; }

  /// Adds the plane of a triangle. The facing's cover knows it from now on, unless the piece reaches through it: such a
  /// plane separates the piece from nothing, and triangles join it one by one.
  void add(Facing& facing, const SeparatedTriangle& separated);
  /// Lets a triangle in contact join the plane of the most similar normal, within 26 degrees. Returns false without one.
  bool join(const Facing& facing, const SeparatedTriangle& separated);

  /// Counts the speed of a part that the plane stands for, as SurfaceMotion::alongNormal() takes it.
  template <typename... Part>
  void quicken(size_t number, const Facing& facing, const Part&... part) {
    SeparatingPlane& plane = planes_[number].plane;
    const SurfaceMotion& motion = *facing.surface->motion;
    const Eigen::Vector3d n_M = facing.cover.normal_M(normal_T(plane));
    const double before = plane.surface_speed;
    plane.surface_speed = std::max(before, motion.moves() ? motion.alongNormal(n_M, part...) : 0.0);
    moveOn(plane, facing.surface->age * (std::max(0.0, plane.surface_speed) - std::max(0.0, before)));
  }

 private:
  Eigen::Vector3d normal_T(const SeparatingPlane& plane) const { return X_WT_.linear().transpose() * plane.normal_W; }
  static void moveOn(SeparatingPlane& plane, double step) {
    plane.gap -= step;
    plane.point_W += step * plane.normal_W;
  }
  ProximityPlane* similar(const Facing& facing, const Eigen::Vector3d& normal_T) const;

  const Eigen::Isometry3d& X_WT_;
  std::vector<ProximityPlane>& planes_;
};

}  // namespace sweep_guard_core
