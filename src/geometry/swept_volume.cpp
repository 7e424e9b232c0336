#include "sweep_guard/geometry/swept_volume.h"

#include <algorithm>
#include <cassert>

#include "geometry/bounding_planes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

VolumeKind volumeKind(const std::string& name) {
  if (name == "obb") return VolumeKind::kObb;
  if (name == "obb_planes") return VolumeKind::kObbPlanes;
  if (name == "hull") return VolumeKind::kHull;
  throw InvalidInput("volume '" + name + "' is unknown: use obb, obb_planes or hull");
}

std::string nameOf(VolumeKind kind) {
  if (kind == VolumeKind::kHull) return "hull";
  return kind == VolumeKind::kObb ? "obb" : "obb_planes";
}

std::vector<HalfSpace> SweptVolume::halfSpaces_B() const {
  std::vector<HalfSpace> half_spaces;
  forEachHalfSpace([&](const Eigen::Vector3d& normal, double offset) { half_spaces.emplace_back(normal, offset); });
  return half_spaces;
}

SweptVolume SweptVolume::grown(double distance) const {
  SweptVolume grown = *this;
  grown.margin += distance;
  grown.box.half_extents.array() += distance;
  for (HalfSpace& clip_B : grown.clips_B) clip_B = clip_B.grown(distance);
  return grown;
}

double deviationBound(const ConvexShape& shape, const Motion& motion) {
  return std::max(chordError(shape.radiusAbout(motion.axis_T()), motion.angle()), motion.deviation_bound);
}

SweptVolume sweptVolume(const ConvexShape& shape, const Motion& motion, VolumeKind kind, double extra_margin) {
  assert(motion.angle() < 1.6 && extra_margin >= 0.0);
  // The volume is computed relative to the tool and moved at the end: far from the mesh's origin it would lose digits.
  const Eigen::Translation3d there(motion.X_MT_start.translation());
  const Motion near{there.inverse() * motion.X_MT_start, there.inverse() * motion.X_MT_end, 0.0,
                    motion.mesh_translation};

  SweptVolume volume;
  volume.box = boundingBox(shape, near);
  if (kind != VolumeKind::kObb) volume.clips_B = boundingPlanes(shape, near, volume.box);
  const Eigen::Vector3d& mean_T = shape.moments_T().mean;
  volume.interior_B = volume.box.X_MB.inverse() * (0.5 * (near.X_MT_start * mean_T + near.X_MT_end * mean_T));
  volume.box.X_MB = there * volume.box.X_MB;

  return volume.grown(deviationBound(shape, motion) + extra_margin);
}

}  // namespace sweep_guard_core
