#pragma once

#include <array>
#include <boost/container/flat_map.hpp>
#include <cstdint>
#include <optional>
#include <vector>

#include "guard/intended_contact.h"
#include "guard/moving_mesh.h"
#include "guard/separating_directions.h"
#include "guard/triangle_set.h"
#include "sweep_guard/guard/contact_policy.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

/// Contact normals by triangle: unit, from the triangle to the tool, in mesh frame M.
using ContactNormals = boost::container::flat_map<std::uint32_t, Eigen::Vector3d>;

struct NarrowPhaseRequest {
  const Tool& tool;
  const std::vector<Motion>& sub_motions;  ///< of one motion, of equal duration, end to end
  const MovingMesh& mesh;
  const std::vector<TriangleSet>& candidates;  ///< one set for each convex piece of the tool
  double margin;                               ///< the tool is grown by this [m], >= 0
  const ContactNormals& contact_normals;       ///< normals of contacts that began earlier
  const ContactPolicy& contact = kForbidAllContact;
};

struct NarrowPhaseResult {
  /// Candidates that the narrow phase cannot rule out: ascending, each once. If the mesh moved, also reports every
  /// triangle whose hull over the interval meets the tool's hull.
  TriangleSet not_ruled_out;
  /// Candidates in contact: ascending, each once. If the mesh moved, its vertices are taken to move at constant speed.
  std::vector<TriangleContact> in_contact;
  /// Triangles of `not_ruled_out` that a piece may meet otherwise than intended: ascending, each once.
  TriangleSet unintended;
};

/// Computes time of impact, contact point, normal and depth of each candidate [P, Sec. 5: "a fine detection"]. Candidates
/// are tested in batches: first those that were in contact before, whether a corner lies in the tool at the start; then
/// the others along directions that separated other triangles; and those that are left one by one. Keeps its buffers, and
/// the directions, between calls.
class NarrowPhase {
 public:
  /// @param[out] result  overwritten; its buffers are used again
  void run(const NarrowPhaseRequest& request, NarrowPhaseResult& result);

 private:
  struct Candidate {
    std::uint32_t index = 0;
    MovingTriangle triangle_M;
    std::optional<Eigen::Vector3d> contact_normal_M;
    std::optional<Impact> impact;
    bool not_ruled_out = false;
  };
  class Piece;

  static void finish(NarrowPhaseResult& result);

  ImpactFinder finder_;
  std::vector<SeparatingDirections> directions_;  // of each piece of the tool
  std::array<Candidate, simd::kBatch> batch_;
};

}  // namespace sweep_guard_core
