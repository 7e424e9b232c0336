#pragma once

#include <boost/container/static_vector.hpp>
#include <string>
#include <vector>

#include "sweep_guard/geometry/half_space.h"
#include "sweep_guard/geometry/oriented_box.h"

namespace sweep_guard_core {

/// The enclosure of a swept volume: an oriented box alone (`obb`), the box clipped by up to four planes (`obb_planes`)
/// [P, Sec. 3.1], or the convex hull of the body at both poses (`hull`). The hull has no planes of its own: its
/// SweptVolume is that of `obb_planes`, and Guard and checkPath() drop triangles that a direction proves to miss the
/// hull, except where Guard has no time left for a prediction.
enum class VolumeKind { kObb, kObbPlanes, kHull };

/// Returns the kind with this name. @throws InvalidInput for any name but `obb`, `obb_planes` and `hull`
VolumeKind volumeKind(const std::string& name);
std::string nameOf(VolumeKind kind);

/// Largest number of clipping planes: every OpenGL has at least this many.
constexpr size_t kMaxClips = 6;
using Clips = boost::container::static_vector<HalfSpace, kMaxClips>;

/// Largest number of half-spaces of a volume: box and clips.
constexpr size_t kMaxHalfSpaces = 6 + kMaxClips;
/// One number for each half-space of a volume, in the order of halfSpaces_B().
using PerHalfSpace = boost::container::static_vector<double, kMaxHalfSpaces>;

/// A convex volume that contains everything a convex body of the tool covers during one motion, arcs and
/// mesh_translation included: a box clipped by half-spaces. Detectors test it. The suffix of a variable of this type
/// names the frame M of the mesh.
struct SweptVolume {
  OrientedBox box;  ///< `margin` included
  Clips clips_B;    ///< in box frame B; `margin` included; at most four from sweptVolume()
  Eigen::Vector3d interior_B = Eigen::Vector3d::Zero();  ///< a point inside of every plane, or on it if margin is 0 [m]
  double margin = 0.0;  ///< distance of every plane from the body at both poses, mesh_translation included [m], >= 0

  /// Returns all half-spaces of the volume in B: sides +X -X +Y -Y +Z -Z of the box, then the clips.
  std::vector<HalfSpace> halfSpaces_B() const;

  /// Calls a function with the unit normal in B and the offset [m] of each half-space, in the same order.
  template <typename Function>
  void forEachHalfSpace(const Function& function) const {
    for (int i = 0; i < 3; ++i) {
      function(Eigen::Vector3d(Eigen::Vector3d::Unit(i)), box.half_extents[i]);
      function(Eigen::Vector3d(-Eigen::Vector3d::Unit(i)), box.half_extents[i]);
    }
    for (const HalfSpace& clip_B : clips_B) function(clip_B.normal(), clip_B.offset());
  }

  /// Returns the volume with every plane moved outwards by `distance` [m], >= 0 (not checked).
  SweptVolume grown(double distance) const;
};

/// Returns a bound [m] on the distance of the points of a body, at any time, from the hull of the body at both poses:
/// the larger one of the bound on their arcs (chordError()) and the motion's deviation_bound. Ignores mesh_translation.
double deviationBound(const ConvexShape& shape, const Motion& motion);

/// Returns the volume that a convex body covers during a motion, in the frame M of the motion.
/// @param motion        turns by less than 1.6 rad (asserted); split() longer ones
/// @param extra_margin  growth of the volume in addition to deviationBound() [m], >= 0 (asserted)
SweptVolume sweptVolume(const ConvexShape& shape, const Motion& motion, VolumeKind kind, double extra_margin = 0.0);

/// Returns half-spaces that clip the box around a swept convex body more tightly: at most two side planes (SCP) and two
/// frontal planes (FCP), all parallel to the X axis of the box [P, Sec. 3.1, Fig. 5]. In box frame B [m].
///
/// A side plane runs through an extreme point of a front face and one of a rear face; a frontal plane runs through
/// extreme points of the front (or rear) faces at both poses. Of the lines in Fig. 5, the function takes the line that
/// cuts the largest area off the box, and moves it out until it touches the body. So no plane cuts off a point of the
/// body, for any shape and motion. Planes that cut nothing off the box are omitted.
Clips boundingPlanes(const ConvexShape& shape, const Motion& motion, const OrientedBox& box);

}  // namespace sweep_guard_core
