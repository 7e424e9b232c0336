#pragma once

#include <optional>

#include "evaluation/recorded_motion.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

/// The tool touches an obstacle that is closer than this [m].
constexpr double kContactTolerance = 1e-6;

/// Returns when the recorded motion first brings the tool into contact with an obstacle; empty: never. Warnings are
/// compared with this time. Conservative advancement: the tool advances by its clearance, because no point of the tool
/// moves farther than the origin moves plus the rotation times the bounding radius. So no contact is missed, and the
/// result is early by at most the time in which the tool moves sqrt(2) * kContactTolerance.
/// @param from, to  within the recording
std::optional<sweep_guard_core::Time> firstContact(const RecordedMotion& motion,
                                                   const sweep_guard_core::ConvexShape& tool,
                                                   const SquareObstacle& obstacle, sweep_guard_core::Time from,
                                                   sweep_guard_core::Time to);

}  // namespace sweep_guard_evaluation
