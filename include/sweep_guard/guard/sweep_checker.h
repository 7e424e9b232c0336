#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "sweep_guard/detection/culler.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/moving_mesh.h"
#include "sweep_guard/guard/narrow_phase.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard_core {

struct SweepOptions {
  VolumeKind volume = VolumeKind::kObbPlanes;
  double max_rotation = 0.175;  ///< largest rotation of one sub-motion [rad], in (0, 1.5]
  double margin = 0.0;          ///< the tool is grown by this [m], >= 0
  bool fine = true;             ///< run the narrow phase on what the swept volumes meet
};

/// What the tool meets of one mesh during one motion.
struct SweepResult {
  TriangleSet triangles;  ///< triangles that a swept volume meets: ascending, each once
  double margin = 0.0;    ///< largest margin of a tested volume [m]: arcs, rounding, mesh motion and requested margin
  std::vector<SweptVolume>
      volumes_M;                   ///< volumes tested, in order of time: of the tool's pieces, or of boxes around them
  bool fine = false;               ///< the narrow phase has run
  TriangleSet not_ruled_out = {};  ///< subset of `triangles` that the narrow phase does not rule out; without it, all
  std::vector<TriangleContact> in_contact = {};  ///< confirmed by the narrow phase: ascending, each once
  bool inside = false;                           ///< a piece of the tool lies wholly inside the closed mesh

  bool contact() const { return inside || !not_ruled_out.empty(); }
  void clear();  ///< resets all fields and keeps the buffers
};

/// What a sweep leaves for the next one.
struct SweepCache {
  ContactNormals contact_normals = {};  ///< of the triangles in contact
  bool outside = false;                 ///< every piece of the tool is known to be outside the mesh
  TriangleSet already_confirmed = {};   ///< triangles that skip the narrow phase: in contact if a volume meets them
};
inline const SweepCache kEmptySweepCache;

struct SweepRequest {
  const Tool& tool;
  const std::vector<Motion>& sub_motions;  ///< from split(); each turns by little, so that its arc needs little margin
  const MovingMesh& mesh;
  SweepOptions options = {};
  const SweepCache& cache = kEmptySweepCache;  ///< of the sweep that ended where this one begins
};

/// Tests the volumes that the tool sweeps during each sub-motion. Descends the tool's tree of boxes to its convex pieces
/// where the boxes meet triangles, and hands the candidates of the pieces to the narrow phase. If the mesh is closed, no
/// triangle is met and the tool was not known to be outside before, tests whether a piece lies inside.
/// Keeps its buffers between calls.
class SweepChecker {
 public:
  /// @returns valid until the next call
  /// @throws DeviceError if the detector fails
  SweepResult& check(Detector& detector, const SweepRequest& request);

 private:
  struct TreeWalk;

  void narrow(const SweepRequest& request);

  SweepResult result_;
  std::vector<TriangleSet> candidates_;  // of each piece of the tool
  Detection detection_;
  Culler culler_;
  std::deque<SubmeshFinder> finders_;  // by depth in the tool's tree
  NarrowPhaseResult narrow_phase_result_;
};

/// Checks one sweep with buffers of its own.
/// @throws DeviceError if the detector fails
SweepResult checkSweep(Detector& detector, const SweepRequest& request);

/// Merges the result of a later sub-motion into `all`. Times of impact stay as they are. Depths are those at the end of
/// the later sub-motion, and 0 for triangles that it does not touch.
void unite(SweepResult& all, const SweepResult& later);

/// Returns what the next sweep needs to know about this one.
SweepCache sweepCache(const SweepResult& result);

/// Returns the first time of impact as a fraction of the sweep, and 0 if the tool is inside throughout. Empty without
/// narrow phase and without contact.
std::optional<double> firstTimeOfImpact(const SweepResult& result);

/// What the tool meets along a path of poses.
struct PathResult {
  SweepResult all;                       ///< of all sweeps, merged by unite()
  std::optional<size_t> first_contact;   ///< first sweep with contact; sweep i goes from pose i to pose i + 1
  std::optional<double> time_of_impact;  ///< in that sweep, [0, 1]; empty without the narrow phase
};

/// Checks every sweep of a path. A path of one pose is a static test.
/// @param path          poses X_MT, at least one
/// @param before_sweep  called before every sweep; may throw to give up
/// @throws DeviceError if the detector fails
PathResult checkPath(
    Detector& detector, const Tool& tool, const std::vector<Eigen::Isometry3d>& path, const TriangleMesh& mesh_M,
    const SweepOptions& options, const std::function<void()>& before_sweep = [] {});

}  // namespace sweep_guard_core
