#pragma once

#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {

/// A pose on a path of the tool frame T through a mesh frame M.
struct PathPoint {
  Duration time{};                                         ///< since any moment; not before that of the waypoint before
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();  ///< translation [m]
  /// Bound on how far a tool point, on its path here from the waypoint before, is off the straight line at constant
  /// speed [m].
  double deviation_bound = 0.0;
};
using Path = std::vector<PathPoint>;

/// One motion in place of several: from one waypoint to a later one, straight and at constant speed. Its deviation_bound bounds
/// how far any tool point is, at any time, from where the path through the path between has it.
///
/// A time of impact found on it with that deviation_bound as margin is thus never late, and early by no more than it takes the
/// tool to come nearer by twice the deviation_bound. Between path of the same time the tool is at every place of the path.
/// @param first        number of a waypoint
/// @param last         number of a waypoint, > first
/// @param tool_radius  largest distance of a tool point from the origin of T [m], >= 0
Motion mergedMotion(const Path& path, size_t first, size_t last, double tool_radius);

/// What may be lost by replacing a path by a chord.
struct MergeLimits {
  double max_deviation;  ///< [m], >= 0
  double max_rotation;   ///< from its start to its end [rad], > 0
};

/// The last waypoint, up to `last`, of a chord from `first` on that keeps the limits; first + 1 if there is none. It is
/// looked for by doubling and halving, so that it costs little more than reading the path: a longer one may exist.
size_t endOfMergedMotion(const Path& path, size_t first, size_t last, double tool_radius, const MergeLimits& limits);

}  // namespace sweep_guard_core
