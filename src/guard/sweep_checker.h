#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "detection/culler.h"
#include "guard/moving_mesh.h"
#include "guard/narrow_phase.h"
#include "guard/triangle_set.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

/// What a sweep leaves for the next one.
struct SweepCache {
  ContactNormals contact_normals = {};  ///< of the triangles in contact
  std::vector<PieceSide> sides = {};    ///< of each piece of the tool; empty: unknown
  TriangleSet already_confirmed = {};   ///< triangles that skip the narrow phase: in contact if a volume meets them
};
inline const SweepCache kEmptySweepCache;

struct SweepRequest {
  const Tool& tool;
  const std::vector<Motion>& sub_motions;  ///< from split(); each turns by little, so that its arc needs little margin
  const MovingMesh& mesh;
  SweepOptions options = {};
  const SweepCache& cache = kEmptySweepCache;  ///< of the sweep that ended where this one begins
  const ContactPolicy& contact = kForbidAllContact;
};

/// Tests the volumes that the tool sweeps during each sub-motion. Descends the tool's tree of boxes to its convex
/// pieces where the boxes meet triangles, and hands the candidates of the pieces to the narrow phase. Pieces that may
/// touch the mesh are tested alike and reported apart. Keeps its buffers between calls.
///
/// If there is no contact, or none but intended, tests whether a piece lies inside. Leaves out pieces that may touch the
/// mesh, and those of links that touch as intended. The side of a piece is kept from sweep to sweep as long as its volumes
/// meet no triangle, or the narrow phase rules out all that the tool met.
class SweepChecker {
 public:
  /// @returns valid until the next call
  /// @throws DeviceError if the detector fails
  SweepResult& check(Detector& detector, const SweepRequest& request);

 private:
  // The triangles that a box of the tool meets, and how many boxes are around it.
  struct Around {
    Submesh submesh;
    size_t depth;
  };

  void clear(size_t pieces);
  std::optional<Around> trianglesMet(const SweptVolume& box_M, const Around& above);
  void addCandidates(size_t piece, bool allowed);
  void test(const SweepRequest& request);
  void narrow(const SweepRequest& request);
  void narrowAllowed(const SweepRequest& request);
  void keepSides(const SweepRequest& request);
  void findSides(const SweepRequest& request);

  SweepResult result_;
  std::vector<TriangleSet> candidates_;  // of each piece of the tool
  std::vector<TriangleSet> allowed_;     // the same, of the pieces that may touch the mesh
  std::vector<bool> touched_;            // of each piece, whether its volume met a triangle
  Detection detection_;
  Culler culler_;
  std::deque<SubmeshFinder> finders_;  // by depth in the tool's tree
  NarrowPhase narrow_phase_;
  NarrowPhaseResult narrow_phase_result_;
};

/// Checks one sweep with buffers of its own.
/// @throws DeviceError if the detector fails
SweepResult checkSweep(Detector& detector, const SweepRequest& request);

/// Merges the result of a later sub-motion into `all`: of each triangle the first contact, but rather one that is not intended.
/// Depths are those at the end of the later sub-motion, and 0 for triangles that it does not touch.
void unite(SweepResult& all, const SweepResult& later);

/// Merges what another body of the tool met in the same time into `all`: of each triangle the first contact, but rather one
/// that is not intended.
/// @param other  counts its pieces and times as `all` does
void uniteBodies(SweepResult& all, const SweepResult& other);

/// Returns what the next sweep needs to know about this one.
SweepCache sweepCache(const SweepResult& result);

/// Returns the first time of impact as a fraction of the sweep, and 0 if the tool is inside throughout. Empty without
/// narrow phase and without contact.
std::optional<double> firstTimeOfImpact(const SweepResult& result);

}  // namespace sweep_guard_core
