#include "geometry/merged_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sweep_guard_core {
namespace {

// Bounds the distance of a tool point between two poses. The difference of two rotations that are an angle apart has
// the operator norm 2 sin(angle / 2), and sqrt(2) times that as Frobenius norm.
double distanceBound(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double tool_radius) {
  return (a.translation() - b.translation()).norm() + tool_radius * M_SQRT1_2 * (a.linear() - b.linear()).norm();
}

}  // namespace

// Between two points, path and merged motion are straight except for their arcs: without arcs, the deviation is largest
// at one of the two points. The last arc is that of the merged motion.
Motion mergedMotion(const Path& path, size_t first, size_t last, double tool_radius) {
  assert(first < last && last < path.size());
  Motion merged_M{path[first].X_MT, path[last].X_MT};
  const double turn = merged_M.angle();
  const double time = toSeconds(path[last].time - path[first].time);
  const auto along = [&](size_t i) {
    if (time > 0.0) return toSeconds(path[i].time - path[first].time) / time;
    return static_cast<double>(i - first) / static_cast<double>(last - first);
  };
  double deviation = 0.0;
  double arc = 0.0;
  for (size_t i = first + 1; i <= last; ++i) {
    if (i < last) deviation = std::max(deviation, distanceBound(merged_M.at(along(i)), path[i].X_MT, tool_radius));
    arc = std::max(arc, path[i].deviation_bound + chordError(tool_radius, (along(i) - along(i - 1)) * turn));
  }
  merged_M.deviation_bound = deviation + arc + chordError(tool_radius, turn);
  return merged_M;
}

size_t endOfMergedMotion(const Path& path, size_t first, size_t last, double tool_radius, const MergeLimits& limits) {
  const auto fits = [&](size_t end) {
    const Motion merged_M = mergedMotion(path, first, end, tool_radius);
    return merged_M.deviation_bound <= limits.max_deviation && merged_M.angle() <= limits.max_rotation;
  };
  size_t end = first + 1;
  size_t step = 1;
  for (; end < last && fits(std::min(end + step, last)); step *= 2) end = std::min(end + step, last);
  for (step /= 2; step > 0; step /= 2) {
    if (end + step < last && fits(end + step)) end += step;
  }
  return end;
}

}  // namespace sweep_guard_core
