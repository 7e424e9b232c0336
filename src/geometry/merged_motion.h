#pragma once

#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {

/// A pose on a path of the tool frame T through a mesh frame M.
struct PathPoint {
  Duration time{};                                         ///< since an arbitrary time, not decreasing
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();  ///< translation [m]
  /// Bound on the deviation [m] of a tool point, between the previous point and this one, from a straight line at
  /// constant speed.
  double deviation_bound = 0.0;
};
using Path = std::vector<PathPoint>;

/// Returns one motion that replaces several: from one point of a path to a later one, straight and at constant speed.
/// Its deviation_bound bounds the distance, at any time, of any tool point from its position on the path.
///
/// A time of impact found on the merged motion with deviation_bound as margin is never late. It is early by at most the
/// time in which the tool approaches by twice deviation_bound. Between points with equal times, the tool counts as
/// being at every place of the path.
/// @param first        index of a point
/// @param last         index of a point, > first
/// @param tool_radius  largest distance of a tool point from the origin of T [m], >= 0
Motion mergedMotion(const Path& path, size_t first, size_t last, double tool_radius);

/// Limits of the replacement of a path by one motion.
struct MergeLimits {
  double max_deviation;  ///< [m], >= 0
  double max_rotation;   ///< of the merged motion [rad], > 0
};

/// Returns the index, at most `last`, of the last point of a merged motion from `first` that keeps the limits; first +
/// 1 if there is none. Searches by doubling and halving, which costs little more than reading the path; a longer motion
/// may exist.
size_t endOfMergedMotion(const Path& path, size_t first, size_t last, double tool_radius, const MergeLimits& limits);

}  // namespace sweep_guard_core
