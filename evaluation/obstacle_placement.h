#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluation/recorded_motion.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

/// An obstacle on or near the path of a recorded motion, and the episode in which it is there.
struct ObstaclePlacement {
  SquareObstacle obstacle;
  sweep_guard_core::Time begin;
  sweep_guard_core::Time end;                     ///< time of the contact, if there is one
  std::optional<sweep_guard_core::Time> contact;  ///< first contact of the recorded motion
};

/// Places obstacles along a motion: squares with sides of 0.1 to 0.3 m.
///
/// The motion runs into every other obstacle: it touches the tool at a random moment, tilted by 0 to 60 degrees against
/// the tool's velocity. Its episode begins 4 s earlier, and there is no contact in the first 2 s. The others are near
/// misses: tilted by 0 to 90 degrees, within 0.1 m of the tool at a random moment, without contact from 4 s before to
/// 6 s after this moment; the episode ends 4 s after it. An episode and the second before it have no gap.
///
/// @param seed  equal seeds give equal placements
/// @return ordered by begin; fewer than requested if the recording has no room for them: it is short, has gaps, or the
///     tool rests
std::vector<ObstaclePlacement> placeObstacles(const RecordedMotion& motion, const sweep_guard_core::ConvexShape& tool,
                                              size_t count, std::uint64_t seed);

}  // namespace sweep_guard_evaluation
