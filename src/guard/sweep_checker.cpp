#include "guard/sweep_checker.h"

#include <algorithm>

#include "common/heartbeat.h"
#include "common/stage_clock.h"
#include "detection/float_planes.h"
#include "detection/inside.h"
#include "guard/swept_body.h"
#include "guard/tool_tree.h"

namespace sweep_guard_core {
namespace {

bool linkTouches(const std::vector<TriangleContact>& in_contact, const Tool& tool, const std::string& link) {
  return std::any_of(in_contact.begin(), in_contact.end(),
                     [&](const TriangleContact& contact) { return tool.pieces()[contact.piece].link == link; });
}

bool ascending(const TriangleContact& a, const TriangleContact& b) { return a.triangle < b.triangle; }

// Keeps time and point of the first contact, and normal and depth of the last.
void unite(std::vector<TriangleContact>& all, const std::vector<TriangleContact>& later) {
  for (TriangleContact& contact : all) {
    const auto again = std::lower_bound(later.begin(), later.end(), contact, ascending);
    const bool touches = again != later.end() && again->triangle == contact.triangle;
    if (touches && contact.intended && !again->intended) contact = *again;
    if (touches) contact.impact.normal_M = again->impact.normal_M;
    contact.impact.depth = touches ? again->impact.depth : 0.0;
  }
  unite(all, later, ascending);
}

// Keeps the contact that is not intended, else the first.
void uniteSimultaneous(std::vector<TriangleContact>& all, const std::vector<TriangleContact>& others) {
  const auto rank = [](const TriangleContact& contact) {
    return std::pair(contact.intended, contact.impact.time_of_impact);
  };
  for (TriangleContact& contact : all) {
    const auto other = std::lower_bound(others.begin(), others.end(), contact, ascending);
    const bool both = other != others.end() && other->triangle == contact.triangle;
    if (both && rank(*other) < rank(contact)) contact = *other;
  }
  unite(all, others, ascending);
}

// A triangle is met as intended only if it is so in both. Before the triangles that are not ruled out are united.
void uniteIntended(SweepResult& all, const SweepResult& later) {
  if (all.intended.empty() && later.intended.empty()) return;
  TriangleSet unintended = all.unintended();
  sweep_guard_core::unite(unintended, later.unintended());
  sweep_guard_core::unite(all.intended, later.intended);
  remove(all.intended, unintended);
}

void uniteButContacts(SweepResult& all, const SweepResult& more) {
  sweep_guard_core::unite(all.triangles, more.triangles);
  all.margin = std::max(all.margin, more.margin);
  all.volumes_M.insert(all.volumes_M.end(), more.volumes_M.begin(), more.volumes_M.end());
  all.fine = more.fine;
  uniteIntended(all, more);
  sweep_guard_core::unite(all.not_ruled_out, more.not_ruled_out);
  all.inside = all.inside || more.inside;
  sweep_guard_core::unite(all.allowed.triangles, more.allowed.triangles);
}

}  // namespace

void AllowedContact::clear() {
  triangles.clear();
  in_contact.clear();
}

void SweepResult::clear() {
  triangles.clear();
  margin = 0.0;
  volumes_M.clear();
  fine = false;
  not_ruled_out.clear();
  in_contact.clear();
  intended.clear();
  inside = false;
  sides.clear();
  allowed.clear();
}

TriangleSet SweepResult::unintended() const {
  TriangleSet triangles_left = not_ruled_out;
  remove(triangles_left, intended);
  return triangles_left;
}

TriangleSet SweepResult::allowedTriangles() const {
  if (!fine) return allowed.triangles;
  TriangleSet touched;
  for (const TriangleContact& contact : allowed.in_contact) touched.push_back(contact.triangle);
  return touched;
}

void unite(SweepResult& all, const SweepResult& later) {
  uniteButContacts(all, later);
  unite(all.in_contact, later.in_contact);
  unite(all.allowed.in_contact, later.allowed.in_contact);
  all.sides = later.sides;
}

void uniteBodies(SweepResult& all, const SweepResult& other) {
  uniteButContacts(all, other);
  uniteSimultaneous(all.in_contact, other.in_contact);
  uniteSimultaneous(all.allowed.in_contact, other.allowed.in_contact);
}

// Planes decide about the boxes; the detector, which costs more for each triangle that it names, about the pieces.
SweepResult& SweepChecker::check(Detector& detector, const SweepRequest& request) {
  clear(request.tool.pieces().size());
  const double margin = request.options.margin + request.mesh.spread();
  for (Motion motion_M : request.sub_motions) {
    motion_M.mesh_translation = request.mesh.translation_M();
    TreeWalk<Around> walk({request.mesh.submesh(), 0});
    while (const auto at = walk.next()) {
      const Tool::Node& node = request.tool.tree()[at->node];
      const SweptBody body = sweptBody(node.shape_T, motion_M, request.options.volume, margin);
      double inflation = 0.0;
      if (node.piece) {
        beat();
        detection_ = detector.detect(at->above.submesh, body.volume_M);
        inflation = detection_.inflation;
        removeMissedByHull(body, request.mesh, detection_);
        addCandidates(*node.piece, request.contact.allows(*node.piece));
      } else if (const auto met = trianglesMet(body.volume_M, at->above)) {
        walk.goBelow(node.below, *met);
        continue;
      }
      result_.margin = std::max(result_.margin, body.volume_M.margin + inflation);
      result_.volumes_M.push_back(body.volume_M);
    }
  }
  test(request);
  return result_;
}

void SweepChecker::clear(size_t pieces) {
  result_.clear();
  for (std::vector<TriangleSet>* const of_pieces : {&candidates_, &allowed_}) {
    of_pieces->resize(pieces);
    for (TriangleSet& candidates : *of_pieces) candidates.clear();
  }
}

void SweepChecker::addCandidates(size_t piece, bool allowed) {
  unite((allowed ? allowed_ : candidates_)[piece], detection_.triangles);
  unite(allowed ? result_.allowed.triangles : result_.triangles, detection_.triangles);
}

// Tests the candidates, and which pieces are inside.
void SweepChecker::test(const SweepRequest& request) {
  result_.fine = request.options.fine;
  result_.not_ruled_out = result_.triangles;
  touched_.assign(candidates_.size(), false);
  for (size_t i = 0; i < candidates_.size(); ++i) touched_[i] = !candidates_[i].empty() || !allowed_[i].empty();
  if (request.options.fine) narrow(request);
  if (request.options.fine && !result_.allowed.triangles.empty()) narrowAllowed(request);
  keepSides(request);
  if (!result_.unintendedContact()) findSides(request);
}

std::optional<SweepChecker::Around> SweepChecker::trianglesMet(const SweptVolume& box_M, const Around& above) {
  const simd::Planes planes = floatPlanes(above.submesh.mesh_M(), box_M);
  while (finders_.size() <= above.depth) finders_.emplace_back();
  const Submesh near = finders_[above.depth].find(above.submesh, planes);
  return culler_.cull(near, planes).empty() ? std::nullopt : std::optional(Around{near, above.depth + 1});
}

// A piece that meets no triangle stays on its side.
void SweepChecker::keepSides(const SweepRequest& request) {
  result_.sides = request.cache.sides;
  result_.sides.resize(touched_.size(), PieceSide::kUnknown);
  const bool ruled_out = result_.not_ruled_out.empty() && result_.allowed.triangles.empty();
  for (size_t i = 0; i < touched_.size(); ++i) {
    if (touched_[i] && !ruled_out) result_.sides[i] = PieceSide::kUnknown;
  }
}

// Not of the links that touch: how deep all their pieces are was measured.
void SweepChecker::findSides(const SweepRequest& request) {
  const Eigen::Isometry3d& X_MT = request.sub_motions.back().X_MT_end;
  for (size_t i = 0; i < result_.sides.size(); ++i) {
    const ConvexPiece& piece = request.tool.pieces()[i];
    if (request.contact.allows(i) || linkTouches(result_.in_contact, request.tool, piece.link)) continue;
    PieceSide& side = result_.sides[i];
    if (side == PieceSide::kUnknown) {
      const bool is_inside = inside(request.mesh.mesh_M(), X_MT * piece.shape_T.moments_T().mean);
      side = is_inside ? PieceSide::kInside : PieceSide::kOutside;
    }
    result_.inside = result_.inside || side == PieceSide::kInside;
  }
}

void SweepChecker::narrow(const SweepRequest& request) {
  const InStage stage(Stage::kNarrowPhase);
  const TriangleSet& confirmed = request.cache.already_confirmed;
  for (TriangleSet& candidates : candidates_) remove(candidates, confirmed);
  narrow_phase_.run({request.tool, request.sub_motions, request.mesh, candidates_, request.options.margin,
                     request.cache.contact_normals, request.contact},
                    narrow_phase_result_);
  keepOnly(result_.not_ruled_out, confirmed);
  unite(result_.not_ruled_out, narrow_phase_result_.not_ruled_out);
  std::swap(result_.in_contact, narrow_phase_result_.in_contact);
  if (!request.contact.intendsAny()) return;
  result_.intended = narrow_phase_result_.not_ruled_out;
  remove(result_.intended, narrow_phase_result_.unintended);
}

// No triangle is intended for a piece that may touch all of them.
void SweepChecker::narrowAllowed(const SweepRequest& request) {
  const InStage stage(Stage::kNarrowPhase);
  narrow_phase_.run({request.tool, request.sub_motions, request.mesh, allowed_, request.options.margin,
                     request.cache.contact_normals},
                    narrow_phase_result_);
  std::swap(result_.allowed.in_contact, narrow_phase_result_.in_contact);
}

SweepResult checkSweep(Detector& detector, const SweepRequest& request) {
  return SweepChecker().check(detector, request);
}

SweepCache sweepCache(const SweepResult& result) {
  SweepCache cache{{}, result.sides, {}};
  for (const TriangleContact& contact : result.in_contact) {
    cache.contact_normals.emplace_hint(cache.contact_normals.end(), contact.triangle, contact.impact.normal_M);
  }
  return cache;
}

std::optional<double> firstTimeOfImpact(const SweepResult& result) {
  if (!result.fine) return std::nullopt;
  if (result.inside) return 0.0;
  std::optional<double> first;
  for (const TriangleContact& contact : result.in_contact) {
    first = std::min(first.value_or(1.0), contact.impact.time_of_impact);
  }
  return first;
}

}  // namespace sweep_guard_core
