#include "sweep_guard/guard/confirmation.h"

#include <algorithm>

#include "sweep_guard/guard/swept_body.h"

namespace sweep_guard {
namespace {

class Look {
 public:
  Look(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh, double margin, const WaysIn& ways_in,
       Confirmation& confirmation)
      : tool_(tool),
        parts_(parts),
        mesh_(mesh),
        margin_(margin + mesh.uncertainty()),
        ways_in_(ways_in),
        met_(confirmation.met),
        touched_(confirmation.touched) {
    met_.clear();
    touched_.clear();
  }

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

  void finish() {
    std::sort(met_.begin(), met_.end());
    met_.erase(std::unique(met_.begin(), met_.end()), met_.end());
  }

 private:
  void keepFirst(const TouchedTriangle& touched) {
    const auto below = [](const TouchedTriangle& one, std::uint32_t triangle) { return one.triangle < triangle; };
    const auto known = std::lower_bound(touched_.begin(), touched_.end(), touched.triangle, below);
    if (known == touched_.end() || known->triangle != touched.triangle) {
      touched_.insert(known, touched);
    } else if (touched.impact.time_of_impact < known->impact.time_of_impact) {
      *known = touched;
    }
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
  TriangleSet& met_;
  std::vector<TouchedTriangle>& touched_;
};

}  // namespace

void confirm(const Tool& tool, const std::vector<Motion>& parts, const MovingMesh& mesh,
             const std::vector<TriangleSet>& candidates, double margin, const WaysIn& ways_in,
             Confirmation& confirmation) {
  Look look(tool, parts, mesh, margin, ways_in, confirmation);
  for (size_t part = 0; part < candidates.size(); ++part) {
    for (const std::uint32_t index : candidates[part]) look.at(index, part);
  }
  look.finish();
}

}  // namespace sweep_guard
