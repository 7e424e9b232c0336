#pragma once

#include <string>
#include <vector>

#include "sweep_guard/geometry/bounding_planes.h"
#include "sweep_guard/geometry/oriented_box.h"

namespace sweep_guard_core {

/// How closely the swept volume is enclosed: by the box alone (`obb`), by box, side and frontal planes (`obb_planes`)
/// [P, Sec. 3.1], or by the convex hull of the body at both poses (`hull`). The hull has no planes of its own: what box
/// and planes meet is left out if a direction proves that the hull does not meet it.
enum class VolumeKind { kObb, kObbPlanes, kHull };

/// @throws InvalidInput on any name but `obb`, `obb_planes` and `hull`
VolumeKind volumeKind(const std::string& name);
std::string nameOf(VolumeKind kind);

/// Of a volume with all its clips: 12 at most.
constexpr size_t kMaxHalfSpaces = 6 + kMaxClips;
/// A number for each of these.
using PerHalfSpace = boost::container::static_vector<double, kMaxHalfSpaces>;

/// A convex volume that holds everything a body of the tool touches during one motion, arcs and mesh_translation included: a box,
/// cut by half-spaces.
/// What a detector tests. The suffix of a variable of this type names the frame M of the mesh it is tested against.
struct SweptVolume {
  OrientedBox box;                                       ///< grown by `margin` already
  Clips clips_B;                                         ///< in box frame B; grown by `margin` already
  Eigen::Vector3d interior_B = Eigen::Vector3d::Zero();  ///< a point of the shape, inside of every plane [m]
  double margin = 0.0;  ///< every plane lies this far outside of the tool's two poses [m], >= 0

  /// The six sides of the box, and the clips: everything that bounds the volume, in B.
  std::vector<HalfSpace> halfSpaces_B() const;

  /// Calls a function with the unit normal in B, and the offset [m], of each of these.
  template <typename Function>
  void forEachHalfSpace(const Function& function) const {
    for (int i = 0; i < 3; ++i) {
      function(Eigen::Vector3d(Eigen::Vector3d::Unit(i)), box.half_extents[i]);
      function(Eigen::Vector3d(-Eigen::Vector3d::Unit(i)), box.half_extents[i]);
    }
    for (const HalfSpace& clip_B : clips_B) function(clip_B.normal(), clip_B.offset());
  }

  /// The volume with every plane moved out by `distance` [m], >= 0.
  SweptVolume grown(double distance) const;
};

/// How far points of a body leave the hull of its two poses during a motion at most [m]: along arcs, and because M
/// turns.
double deviationBound(const ConvexShape& shape, const Motion& motion);

/// What a convex body of the tool covers during a motion.
/// @param motion        turns by at most 90 degrees; split() longer ones
/// @param extra_margin  the volume is grown by this, besides what the arcs of the rotation need [m], >= 0
SweptVolume sweptVolume(const ConvexShape& shape, const Motion& motion, VolumeKind kind, double extra_margin = 0.0);

}  // namespace sweep_guard_core
