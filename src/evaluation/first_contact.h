#pragma once

#include <optional>

#include "evaluation/recorded_motion.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

/// A obstacle as near as this is touched [m].
constexpr double kContactTolerance = 1e-6;

/// When the recorded motion first brings the tool into contact with a obstacle: the truth that warnings are compared with.
/// Conservative advancement: as far as the tool is clear of the obstacle it may move unseen, for no point of it goes
/// farther than its origin goes and its turn takes the farthest point. So no contact is missed, and the one found is
/// early by no more than the tool needs for sqrt(2) * kContactTolerance.
/// @param from, to  within the recording
/// @returns empty: none
std::optional<sweep_guard_core::Time> firstContact(const RecordedMotion& motion,
                                                   const sweep_guard_core::ConvexShape& tool,
                                                   const SquareObstacle& obstacle, sweep_guard_core::Time from,
                                                   sweep_guard_core::Time to);

}  // namespace sweep_guard_evaluation
