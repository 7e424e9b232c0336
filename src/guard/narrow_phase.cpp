#include "guard/narrow_phase.h"

#include <algorithm>

#include "common/heartbeat.h"
#include "guard/swept_body.h"

namespace sweep_guard_core {
namespace {

class NarrowPhase {
 public:
  NarrowPhase(const NarrowPhaseRequest& request, NarrowPhaseResult& result)
      : request_(request), margin_(request.margin + request.mesh.uncertainty()), result_(result) {
    result_.not_ruled_out.clear();
    result_.in_contact.clear();
  }

  void check(std::uint32_t index, size_t piece) {
    beat();
    const ConvexShape& shape_T = request_.tool.pieces()[piece].shape_T;
    const MovingTriangle triangle = request_.mesh.triangle(index);
    const auto earlier = request_.contact_normals.find(index);
    const auto normal = earlier == request_.contact_normals.end() ? std::nullopt : std::optional(earlier->second);
    if (const auto impact = timeOfImpact(shape_T, request_.sub_motions, triangle, margin_, normal)) {
      result_.not_ruled_out.push_back(index);
      keepFirst({index, piece, *impact});
    } else if (request_.mesh.moved() && hullsMeet(shape_T, triangle)) {
      result_.not_ruled_out.push_back(index);
    }
  }

  void finish() {
    TriangleSet& all = result_.not_ruled_out;
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }

 private:
  void keepFirst(const TriangleContact& contact) {
    std::vector<TriangleContact>& all = result_.in_contact;
    const auto below = [](const TriangleContact& other, std::uint32_t triangle) { return other.triangle < triangle; };
    const auto place = std::lower_bound(all.begin(), all.end(), contact.triangle, below);
    if (place == all.end() || place->triangle != contact.triangle) {
      all.insert(place, contact);
    } else if (contact.impact.time_of_impact < place->impact.time_of_impact) {
      *place = contact;
    }
  }

  bool hullsMeet(const ConvexShape& shape_T, const MovingTriangle& triangle) const {
    return std::any_of(request_.sub_motions.begin(), request_.sub_motions.end(), [&](const Motion& motion_M) {
      return !missedByHull(shape_T, motion_M, triangle, margin_ + deviationBound(shape_T, motion_M));
    });
  }

  const NarrowPhaseRequest& request_;
  double margin_;
  NarrowPhaseResult& result_;
};

}  // namespace

void runNarrowPhase(const NarrowPhaseRequest& request, NarrowPhaseResult& result) {
  NarrowPhase narrow_phase(request, result);
  for (size_t piece = 0; piece < request.candidates.size(); ++piece) {
    for (const std::uint32_t index : request.candidates[piece]) narrow_phase.check(index, piece);
  }
  narrow_phase.finish();
}

}  // namespace sweep_guard_core
