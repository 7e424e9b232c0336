#pragma once

#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard {

/// A pose on a way of the tool frame T through a mesh frame M.
struct Waypoint {
  Duration time{};                                         ///< since any moment; not before that of the waypoint before
  Eigen::Isometry3d X_MT = Eigen::Isometry3d::Identity();  ///< translation [m]
  /// Bound on how far a tool point, on its way here from the waypoint before, is off the straight line at constant
  /// speed [m].
  double arc = 0.0;
};
using Waypoints = std::vector<Waypoint>;

/// One motion in place of several: from one waypoint to a later one, straight and at constant speed. Its bulge bounds
/// how far any tool point is, at any time, from where the way through the waypoints between has it.
///
/// A time of impact found on it with that bulge as margin is thus never late, and early by no more than it takes the
/// tool to come nearer by twice the bulge. Between waypoints of the same time the tool is at every place of the way.
/// @param first        number of a waypoint
/// @param last         number of a waypoint, > first
/// @param tool_extent  largest distance of a tool point from the origin of T [m], >= 0
Motion chord(const Waypoints& way, size_t first, size_t last, double tool_extent);

/// What may be lost by replacing a way by a chord.
struct ChordLimits {
  double max_bulge;     ///< [m], >= 0
  double max_rotation;  ///< from its start to its end [rad], > 0
};

/// The last waypoint, up to `last`, of a chord from `first` on that keeps the limits; first + 1 if there is none. It is
/// looked for by doubling and halving, so that it costs little more than reading the way: a longer one may exist.
size_t lastOfChord(const Waypoints& way, size_t first, size_t last, double tool_extent, const ChordLimits& limits);

}  // namespace sweep_guard
