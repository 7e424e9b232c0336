#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "sweep_guard/detection/cull.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/confirmation.h"
#include "sweep_guard/guard/moving_mesh.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {

struct SweepOptions {
  VolumeKind volume = VolumeKind::kObbPlanes;
  double max_rotation = 0.175;  ///< a motion that turns more is split [rad], in (0, 1.5]
  double margin = 0.0;          ///< the tool is grown by this [m], >= 0
  bool fine = true;             ///< the fine phase confirms what the volumes meet
};

/// What the tool meets of one mesh while it moves.
struct SweepFindings {
  TriangleSet triangles;  ///< those that a swept volume meets: ascending, each once
  double margin = 0.0;    ///< largest growth of a volume tested [m]: arcs, rounding, a mesh that moves, as asked for
  /// Those tested, end to end, in the mesh's frame: of the tool's parts, and where a box around several meets nothing,
  /// of that.
  std::vector<SweptVolume> volumes_M;
  bool fine = false;     ///< the fine phase has run
  TriangleSet met = {};  ///< of `triangles`, those that the fine phase does not rule out; without it, all
  std::vector<TouchedTriangle> touched = {};  ///< confirmed by the fine phase: ascending, each once
  bool inside = false;                        ///< a part of the tool is wholly inside of the closed mesh

  bool contact() const { return inside || !met.empty(); }
  void clear();  ///< as new; keeps its buffers
};

/// What a sweep leaves behind.
struct SweptBefore {
  WaysIn ways_in;        ///< of the triangles touched
  bool outside = false;  ///< every part of the tool is known to be outside of the mesh
  TriangleSet settled;   ///< need no closer look: met, if a volume meets them
};

/// Tests the volumes that the tool sweeps in each part of its motion: down the tree of its boxes, as far as they meet
/// something, to its convex parts. What these meet goes to the fine phase. If the mesh is closed and nothing is met, it
/// remains to be tested whether a part of the tool is inside; but not if all were outside before, for nothing gets in
/// without meeting the surface.
/// @param parts    of split(): each turns by little, so that the margin for its arc stays small
/// @param before  of the sweep that ended where this one begins
/// @throws DeviceError if the detector fails
SweepFindings testSweep(Detector& detector, const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh,
                        const SweepOptions& options, const SweptBefore& before = {});

/// The same, again and again: keeps its buffers between calls.
class SweepTest {
 public:
  /// @returns valid until the next call
  SweepFindings& operator()(Detector& detector, const Tool& tool, const std::vector<Motion>& parts,
                            const MovingMesh& mesh, const SweepOptions& options, const SweptBefore& before);

 private:
  struct TreeWalk;

  void confirmMet(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh, double margin,
                  const SweptBefore& before);

  SweepFindings findings_;
  std::vector<TriangleSet> met_by_;  // each part of the tool
  Detection detection_;
  Cull cull_;
  std::deque<PartFinder> finders_;  // by depth in the tool's tree
  Confirmation confirmation_;
};

/// Takes in what was found in a later part of the same motion. Times of impact stay as they are, of either part; depths
/// are those at the end of the later one, 0 of what it does not touch.
void unite(SweepFindings& all, const SweepFindings& more);

/// What the next sweep is to know of this one.
SweptBefore known(const SweepFindings& findings);

/// When contact begins, as a fraction of the sweep: the first time of impact, 0 for a tool that is inside all along.
/// Empty without the fine phase, or without contact.
std::optional<double> firstTime(const SweepFindings& findings);

/// What the tool meets along a path of poses.
struct PathFindings {
  SweepFindings all;                     ///< of all sweeps, as of unite()
  std::optional<size_t> first_met;       ///< first sweep with contact; sweep i goes from pose i to pose i + 1
  std::optional<double> time_of_impact;  ///< in that sweep, [0, 1]; empty without the fine phase
};

/// Tests every sweep of a path; a path of one pose is tested where it stands.
/// @param path     at least one X_MT
/// @param between  called before every sweep; may throw to give up
/// @throws DeviceError if the detector fails
PathFindings testPath(
    Detector& detector, const Tool& tool, const std::vector<Eigen::Isometry3d>& path, const TriangleMesh& mesh_M,
    const SweepOptions& options, const std::function<void()>& between = [] {});

}  // namespace sweep_guard
