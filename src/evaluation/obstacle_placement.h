#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluation/recorded_motion.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

struct ObstaclePlacementOptions {
  size_t count = 80;       ///< half of them to be run into, half to be missed
  std::uint64_t seed = 1;  ///< the same placements every time
};

/// A obstacle in the way of a recorded motion, or beside it, and the episode in which it is there.
struct ObstaclePlacement {
  SquareObstacle obstacle;
  sweep_guard_core::Time begin;
  sweep_guard_core::Time end;                     ///< that of the contact, if there is one
  std::optional<sweep_guard_core::Time> contact;  ///< the first, of the recorded motion itself
};

/// Places sheets along a motion: squares of 0.1 to 0.3 m.
///
/// Every other one is to be run into: it touches the tool where that is at a random moment, tilted by 0 to 60 degrees
/// against its velocity; it is there from 4 s before, and untouched for the first 2 s at least. The others are near
/// misses: tilted by 0 to 90 degrees, they are within 0.1 m of the tool at a random moment but not touched from 4 s
/// before to 6 s after; they are there until 4 s after. An episode and the second before it are without a gap.
///
/// @returns ordered by begin; fewer than asked for where the recording has no room: the tool rests, is too short, has
/// gaps
std::vector<ObstaclePlacement> placeObstacles(const RecordedMotion& motion, const sweep_guard_core::ConvexShape& tool,
                                              const ObstaclePlacementOptions& options);

}  // namespace sweep_guard_evaluation
