#include "guard/narrow_phase.h"

#include <algorithm>

#include "common/heartbeat.h"
#include "guard/swept_body.h"

namespace sweep_guard_core {
namespace {

constexpr double kSameNormal = 0.999;  // cosine of the angle to a direction that serves as well

// One that is not intended goes first.
bool earlierOfTriangle(const TriangleContact& a, const TriangleContact& b) {
  if (a.triangle != b.triangle) return a.triangle < b.triangle;
  if (a.intended != b.intended) return b.intended;
  return a.impact.time_of_impact < b.impact.time_of_impact;
}

void sortUnique(TriangleSet& all) {
  if (!std::is_sorted(all.begin(), all.end())) std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

bool sameTriangle(const TriangleContact& a, const TriangleContact& b) { return a.triangle == b.triangle; }

}  // namespace

// Tests one piece of the tool.
class NarrowPhase::Piece {
 public:
  Piece(NarrowPhase& all, const NarrowPhaseRequest& request, size_t piece, NarrowPhaseResult& result)
      : request_(request),
        piece_(piece),
        shape_T_(request.tool.pieces()[piece].shape_T),
        margin_(request.margin + request.mesh.uncertainty()),
        finder_(all.finder_),
        directions_(all.directions_[piece]),
        batch_(all.batch_),
        result_(result),
        intended_(request.contact.trianglesIntendedFor(piece, request.sub_motions, margin_)),
        normal_(request.contact_normals.begin()) {
    finder_.begin(shape_T_, request.sub_motions, margin_);
    directions_.begin(shape_T_, request.sub_motions, margin_);
  }

  // Tests up to kBatch triangles. Those in contact before are likely to be so at the start.
  void check(const std::uint32_t* triangles, size_t count) {
    bool left = false;
    for (size_t i = 0; i < count; ++i) {
      load(batch_[i], triangles[i]);
      if (batch_[i].contact_normal_M) findOverlap(batch_[i]);
      if (!batch_[i].impact) directions_.load(i, batch_[i].triangle_M, request_.mesh.moved());
      left = left || !batch_[i].impact;
    }
    if (left) checkAlongDirections(count);
    for (size_t i = 0; i < count; ++i) report(batch_[i]);
  }

 private:
  void load(Candidate& candidate, std::uint32_t index) {
    beat();
    candidate.index = index;
    candidate.triangle_M = request_.mesh.triangle(index);
    candidate.contact_normal_M = contactNormal(index);
    candidate.impact.reset();
    candidate.not_ruled_out = false;
  }

  void findOverlap(Candidate& candidate) {
    candidate.impact = finder_.overlapAtStart(candidate.triangle_M, candidate.contact_normal_M);
    candidate.not_ruled_out = candidate.impact.has_value();
  }

  // The triangles ascend.
  std::optional<Eigen::Vector3d> contactNormal(std::uint32_t index) {
    const auto end = request_.contact_normals.end();
    while (normal_ != end && normal_->first < index) ++normal_;
    return normal_ != end && normal_->first == index ? std::optional(normal_->second) : std::nullopt;
  }

  void checkAlongDirections(size_t count) {
    directions_.separate();
    for (size_t i = 0; i < count; ++i) {
      Candidate& candidate = batch_[i];
      if (candidate.impact || directions_.separated(i)) continue;
      if (!candidate.contact_normal_M) findOverlap(candidate);
      if (!candidate.impact) search(candidate, directions_.best_M(i));
    }
  }

  void search(Candidate& candidate, const Eigen::Vector3d& guess_M) {
    beat();
    const auto [impact, direction_M] = finder_.find(candidate.triangle_M, candidate.contact_normal_M, guess_M);
    candidate.impact = impact;
    candidate.not_ruled_out =
        candidate.impact || (request_.mesh.moved() && hullsMeet(candidate.triangle_M, direction_M));
    const bool is_new = !candidate.not_ruled_out || direction_M.dot(guess_M) < kSameNormal;
    if (is_new && !direction_M.isZero(0.0)) directions_.add(direction_M);
  }

  bool hullsMeet(const MovingTriangle& triangle_M, const Eigen::Vector3d& guess_M) const {
    return std::any_of(request_.sub_motions.begin(), request_.sub_motions.end(), [&](const Motion& motion_M) {
      return !missedByHull(shape_T_, motion_M, triangle_M, margin_ + deviationBound(shape_T_, motion_M), guess_M);
    });
  }

  void report(const Candidate& candidate) {
    if (!candidate.not_ruled_out) return;
    const bool intended = !intended_.empty() && intended_.contains(candidate.index, candidate.triangle_M);
    result_.not_ruled_out.push_back(candidate.index);
    if (!intended) result_.unintended.push_back(candidate.index);
    if (candidate.impact) result_.in_contact.push_back({candidate.index, piece_, *candidate.impact, intended});
  }

  const NarrowPhaseRequest& request_;
  size_t piece_;
  const ConvexShape& shape_T_;
  double margin_;
  ImpactFinder& finder_;
  SeparatingDirections& directions_;
  std::array<Candidate, simd::kBatch>& batch_;
  NarrowPhaseResult& result_;
  IntendedTriangles intended_;
  ContactNormals::const_iterator normal_;
};

void NarrowPhase::run(const NarrowPhaseRequest& request, NarrowPhaseResult& result) {
  result.not_ruled_out.clear();
  result.in_contact.clear();
  result.unintended.clear();
  directions_.resize(request.candidates.size());
  for (size_t piece = 0; piece < request.candidates.size(); ++piece) {
    const TriangleSet& candidates = request.candidates[piece];
    if (candidates.empty()) continue;
    Piece one(*this, request, piece, result);
    for (size_t first = 0; first < candidates.size(); first += simd::kBatch) {
      one.check(&candidates[first], std::min(simd::kBatch, candidates.size() - first));
    }
  }
  finish(result);
}

// Several pieces may touch the same triangle.
void NarrowPhase::finish(NarrowPhaseResult& result) {
  sortUnique(result.not_ruled_out);
  sortUnique(result.unintended);
  std::vector<TriangleContact>& contacts = result.in_contact;
  if (!std::is_sorted(contacts.begin(), contacts.end(), earlierOfTriangle)) {
    std::sort(contacts.begin(), contacts.end(), earlierOfTriangle);
  }
  contacts.erase(std::unique(contacts.begin(), contacts.end(), sameTriangle), contacts.end());
}

}  // namespace sweep_guard_core
