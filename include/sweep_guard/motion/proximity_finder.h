#pragma once

// Idea: few planes stand for all surfaces near a tool, so whoever limits a motion looks at no mesh. A best-first search
// [Hjaltason and Samet 1999] over all pairs of a convex piece and a mesh descends through the boxes of the mesh (groups,
// clusters, triangles), and takes the part next that may be nearest to its piece. The pieces of a body join the search
// when the box around all of them may be nearest to a mesh. A part that lies wholly behind a plane
// of its pair is done; any other triangle gets a plane of its own, along the direction of separation(). Invariant: each
// triangle lies behind a plane of its pair or in a part that waits, and no part that waits is nearer than the first; so
// the search may end at any time, at the reach or out of planes, and one distance bounds all that it leaves over. Cost:
// a distance of boxes for each part that no plane covers, and a separation() only for triangles that may be the nearest;
// no allocation once the buffers have grown.

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/allowed_contact.h"
#include "sweep_guard/guard/intention.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/sweep.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/separating_plane.h"

namespace sweep_guard_core {

/// The bodies of a tool, each in its own frame. Their pieces are counted through.
using BodyTools = boost::container::small_vector<const Tool*, 8>;

/// A tool at one pose, among workpieces. Its bodies are as many as those of the pose (asserted).
struct ProximityRequest {
  BodyTools bodies;  ///< in the order of PoseWithFrames::bodies; they must outlive the search
  const PoseWithFrames& pose;
  const Workpieces& workpieces;
  double reach;  ///< surfaces farther from the tool need no plane [m], > 0
  /// Sweep to this pose: a triangle that the tool overlaps keeps the normal that it was first touched with. Null: the
  /// normal of the triangle is taken, to the side that frees the tool sooner.
  const SweepReport* swept = nullptr;
  /// Where contact is meant: a triangle that a link is meant to touch counts from the intended depth on, for the pieces of this
  /// link. Null: nowhere.
  const Intentions* intentions = nullptr;
  /// A workpiece is no surface for the pieces that may touch it. Null: none may.
  const AllowedPairs* allowed = nullptr;
};

/// A plane and what it was made for.
struct ProximityPlane {
  SeparatingPlane plane;
  std::shared_ptr<const Workpiece> workpiece;  ///< of which a part lies behind the plane
  std::uint32_t triangle;                      ///< nearest triangle behind the plane, for which it was made
  bool contact;                                ///< the piece overlaps the triangles that the plane stands for
};

/// The surfaces around a tool.
struct Proximity {
  /// The nearest first. For each piece of the tool, each triangle within reach lies wholly behind one of them, or no
  /// nearer than `uncovered.distance`.
  std::vector<ProximityPlane> planes;
  UncoveredSurfaces uncovered;  ///< what no plane stands for, also beyond the reach; infinitely far: there is nothing
  Workpieces unplaced;          ///< left out because their frame is unknown at the pose
};

/// Finds separating planes that stand for all surfaces near a tool. A plane touches its triangle, moved to the tool by a
/// twentieth of its gap, so that one stands for a surface that is nearly flat. In contact the gap is negative, and the
/// plane stands for the triangles in contact with nearly the same normal, and for nothing else that lies behind it.
///
/// The speed of a surface is the mean one between the two latest deformations that find() got of a workpiece, by their
/// stamps, plus that of the mesh frame between the two latest poses. It is not less than that of the fastest vertex that
/// the plane stands for, and 0 before a second deformation. It stays until the next deformation: that no update comes
/// does not mean that the surface rests. For the time between the deformation and the pose, up to 1 s, a surface that comes
/// nearer counts as having gone on at that speed. How a vertex moved between two updates is not known.
class ProximityFinder {
 public:
  static constexpr size_t kMaxPlanes = 64;

  ProximityFinder();
  ~ProximityFinder();
  ProximityFinder(const ProximityFinder&) = delete;
  ProximityFinder& operator=(const ProximityFinder&) = delete;

  /// @param[out] proximity  overwritten; its buffers are used again
  void find(const ProximityRequest& request, Proximity& proximity);

  void reset();  ///< forgets earlier deformations and poses: surfaces count as at rest until they move again

 private:
  class Search;
  const std::unique_ptr<Search> search_;
};

}  // namespace sweep_guard_core
