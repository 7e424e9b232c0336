#include "sweep_guard/guard/sweep.h"

#include <algorithm>
#include <cassert>

#include "guard/sweep_checker.h"

namespace sweep_guard_core {
namespace {

// Without a deviation, the last sub-motion ends at the very bits of the pose.
std::vector<Motion> subMotions(const PathRequest& request, size_t sweep) {
  const std::vector<Eigen::Isometry3d>& path = request.path;
  Motion motion{path[sweep], path[std::min(sweep + 1, path.size() - 1)]};
  if (!request.deviation_bounds.empty()) motion.deviation_bound = request.deviation_bounds[sweep];
  if (motion.deviation_bound == 0.0) return split(motion, request.options.max_rotation);
  return split(RelativeMotion{motion, {}}, request.options.max_rotation, request.tool.boundingRadius());
}

std::optional<size_t> firstPiece(const SweepResult& sweep) {
  const auto earlier = [](const TriangleContact& a, const TriangleContact& b) {
    return a.impact.time_of_impact < b.impact.time_of_impact;
  };
  const auto first = std::min_element(sweep.in_contact.begin(), sweep.in_contact.end(), earlier);
  return first == sweep.in_contact.end() ? std::nullopt : std::optional(first->piece);
}

template <typename Is>
bool anyOf(const SweepReport& report, const Is& is) {
  return std::any_of(report.objects.begin(), report.objects.end(), is) ||
         std::any_of(report.replaced.begin(), report.replaced.end(), is);
}

}  // namespace

PathResult checkPath(Detector& detector, const PathRequest& request) {
  const std::vector<Eigen::Isometry3d>& path = request.path;
  assert(!path.empty());
  PathResult result;
  SweepCache cache;
  for (size_t i = 0; i < std::max<size_t>(path.size() - 1, 1); ++i) {
    request.before_sweep();
    const SweepResult sweep = checkSweep(
        detector, {request.tool, subMotions(request, i), request.mesh_M, request.options, cache, request.contact});
    if (sweep.contact() && !result.first_contact) {
      result.first_contact = i;
      result.time_of_impact = firstTimeOfImpact(sweep);
      result.piece = firstPiece(sweep);
    }
    cache = sweepCache(sweep);
    unite(result.all, sweep);
  }
  return result;
}

double SweepReport::margin() const {
  double largest = 0.0;
  for (const SweptObject& object : objects) largest = std::max(largest, object.result.margin);
  return largest;
}

bool SweepReport::contact() const {
  return anyOf(*this, [](const SweptObject& object) { return object.result.contact(); });
}

bool SweepReport::unintendedContact() const {
  return anyOf(*this, [](const SweptObject& object) { return object.result.unintendedContact(); });
}

bool SweepReport::complete() const {
  const auto current = [](const SweptObject& object) { return object.behind == Duration::zero(); };
  return !objects.empty() && unplaced.empty() && failures.empty() &&
         std::all_of(objects.begin(), objects.end(), current);
}

}  // namespace sweep_guard_core
