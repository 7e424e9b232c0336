#include "sweep_guard/guard/confirmation.h"

#include <algorithm>
#include <map>

#include "sweep_guard/guard/swept_body.h"

namespace sweep_guard {
namespace {

class Look {
 public:
  Look(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh, double margin, const WaysIn& ways_in)
      : tool_(tool), parts_(parts), mesh_(mesh), margin_(margin + mesh.uncertainty()), ways_in_(ways_in) {}

  void at(std::uint32_t index, size_t part) {
    const ConvexShape& shape_T = tool_.parts()[part].shape_T;
    const MovingTriangle triangle = mesh_.triangle(index);
    const auto known = ways_in_.find(index);
    const auto way_in = known == ways_in_.end() ? std::nullopt : std::optional(known->second);
    if (const auto impact = firstImpact(shape_T, parts_, triangle, margin_, way_in)) {
      met_.push_back(index);
      keepFirst({index, part, *impact});
    } else if (mesh_.moved() && mayMeet(shape_T, triangle)) {
      met_.push_back(index);
    }
  }

  Confirmation finish() && {
    std::sort(met_.begin(), met_.end());
    met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
    Confirmation confirmation{std::move(met_), {}};
    for (const auto& [index, touched] : touched_) confirmation.touched.push_back(touched);
    return confirmation;
  }

 private:
  void keepFirst(const TouchedTriangle& touched) {
    const auto [known, is_new] = touched_.emplace(touched.triangle, touched);
    if (!is_new && touched.impact.time_of_impact < known->second.impact.time_of_impact) known->second = touched;
  }

  bool mayMeet(const ConvexShape& shape_T, const MovingTriangle& triangle) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Motion& motion_M) {
      return !missedByHull(shape_T, motion_M, triangle, margin_ + arcMargin(shape_T, motion_M));
    });
  }

  const Tool& tool_;
  const std::vector<Motion>& parts_;
  const MovingMesh& mesh_;
  double margin_;
  const WaysIn& ways_in_;
  TriangleSet met_;
  std::map<std::uint32_t, TouchedTriangle> touched_;
};

}  // namespace

Confirmation confirm(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh,
                     const std::vector<TriangleSet>& candidates, double margin, const WaysIn& ways_in) {
  Look look(tool, parts, mesh, margin, ways_in);
  for (size_t part = 0; part < candidates.size(); ++part) {
    for (const std::uint32_t index : candidates[part]) look.at(index, part);
  }
  return std::move(look).finish();
}

}  // namespace sweep_guard
