#include "guard/segment_contacts.h"

#include <algorithm>
#include <utility>

#include "common/heartbeat.h"

namespace sweep_guard_core {
namespace {

bool among(const TriangleSet& set, std::uint32_t triangle) {
  return std::binary_search(set.begin(), set.end(), triangle);
}

void add(const PieceApproach& approach, SegmentContacts& contacts) {
  contacts.meets = true;
  contacts.nearest = nearer(contacts.nearest, approach);
}

}  // namespace

void SegmentContacts::clear() {
  meets = false;
  nearest = {};
  newly_met.clear();
  only_volume = false;
}

void SegmentContactFinder::detect(Detector& detector, const WorkpieceOnPath& on_path, const Submesh& submesh,
                                  const std::vector<UnseparatedPiece>& pieces, const PredictedObject& so_far,
                                  bool compare_hulls, SegmentContacts& contacts) {
  contacts.clear();
  contacts.only_volume = compare_hulls;
  for (const UnseparatedPiece& piece : pieces) {
    beat();
    detection_ = detector.detect(submesh, piece.body.volume_M);
    if (keepNewlyMet(on_path, submesh.mesh_M(), piece, so_far, contacts.only_volume)) add(piece.approach, contacts);
    unite(contacts.newly_met, detection_.triangles);
  }
}

// Keeps of the detected triangles those that the piece meets and that are not reported yet. Returns whether it meets any: of
// those that are reported, one is enough.
bool SegmentContactFinder::keepNewlyMet(const WorkpieceOnPath& on_path, const TriangleMesh& mesh_M,
                                        const UnseparatedPiece& piece, const PredictedObject& so_far,
                                        bool& only_volume) {
  IntendedTriangles intended = on_path.intendedFor(*piece.approach.piece, piece.body.motion_M);
  const bool is_hull = piece.body.kind == VolumeKind::kHull;
  const MovingMesh mesh(mesh_M);
  bool meets = false;
  const auto isNewlyMet = [&](std::uint32_t triangle) {
    const bool is_reported = among(so_far.considered, triangle) || among(so_far.reflex, triangle);
    if (is_reported && meets && !only_volume) return false;
    beat();
    if (intended.contains(triangle, mesh_M)) return false;
    if (is_hull && misses(piece.body, mesh.triangle(triangle), detection_.inflation)) return false;
    meets = true;
    only_volume = only_volume && misses(piece.body, mesh.triangle(triangle));
    return !is_reported;
  };
  TriangleSet& triangles = detection_.triangles;
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), std::not_fn(isNewlyMet)), triangles.end());
  return meets;
}

// Most pieces name the same triangles: they are sorted at the end.
void SegmentContactFinder::assume(const WorkpieceOnPath& on_path, const Submesh& submesh,
                                  const std::vector<UnseparatedPiece>& pieces, SegmentContacts& contacts) {
  contacts.clear();
  assumed_.assign(submesh.mesh_M().triangles().size(), 0);
  for (const UnseparatedPiece& piece : pieces) {
    IntendedTriangles intended = on_path.intendedFor(*piece.approach.piece, piece.body.motion_M);
    bool meets = false;
    for (const std::uint32_t triangle : meter_.notSeparated(submesh, piece.body.volume_M)) {
      if (intended.contains(triangle, submesh.mesh_M())) continue;
      meets = true;
      if (std::exchange(assumed_[triangle], 1) == 0) contacts.newly_met.push_back(triangle);
    }
    if (meets) add(piece.approach, contacts);
  }
  std::sort(contacts.newly_met.begin(), contacts.newly_met.end());
}

}  // namespace sweep_guard_core
