#include "sweep_guard/guard/sweep.h"

#include <algorithm>
#include <cassert>

#include "guard/sweep_checker.h"

namespace sweep_guard_core {

PathResult checkPath(Detector& detector, const PathRequest& request) {
  const std::vector<Eigen::Isometry3d>& path = request.path;
  assert(!path.empty());
  PathResult result;
  SweepCache cache;
  for (size_t i = 0; i < std::max<size_t>(path.size() - 1, 1); ++i) {
    request.before_sweep();
    const Motion motion{path[i], path[std::min(i + 1, path.size() - 1)]};
    const std::vector<Motion> sub_motions = split(motion, request.options.max_rotation);
    const SweepResult sweep = checkSweep(detector, {request.tool, sub_motions, request.mesh_M, request.options, cache});
    if (sweep.contact() && !result.first_contact) {
      result.first_contact = i;
      result.time_of_impact = firstTimeOfImpact(sweep);
    }
    cache = sweepCache(sweep);
    unite(result.all, sweep);
  }
  return result;
}

}  // namespace sweep_guard_core
