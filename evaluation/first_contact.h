#pragma once

#include <functional>
#include <optional>

#include "evaluation/recorded_motion.h"
#include "evaluation/square_obstacle.h"

namespace sweep_guard_evaluation {

/// The tool touches an obstacle that is closer than this [m].
constexpr double kContactTolerance = 1e-6;

/// Returns a lower bound on the distance [m] between the tool at a pose X_WT and an obstacle; 0: in contact.
using ClearanceAt = std::function<double(const Eigen::Isometry3d& X_WT)>;

/// Returns the clearance of an obstacle from a test that is true if the tool, grown by `margin` [m], meets it, and false
/// if it is farther than sqrt(2) * `margin`. The result keeps its last value as the first guess of the next call.
/// @param center_W, radius  of a ball around the obstacle [m]
ClearanceAt clearanceFrom(const sweep_guard_core::ConvexShape& tool, const Eigen::Vector3d& center_W, double radius,
                          std::function<bool(const Eigen::Isometry3d& X_WT, double margin)> intersects);

/// Returns the earliest time at which a tool point may have moved by `distance` [m], rounded down; at most `limit`.
/// @param from, limit  within the recording
sweep_guard_core::Time earliestArrival(const RecordedMotion& motion, const sweep_guard_core::ConvexShape& tool,
                                       sweep_guard_core::Time from, sweep_guard_core::Time limit, double distance);

/// Returns when the recorded motion first brings the tool into contact with an obstacle; empty: never. Warnings are
/// compared with this time. Conservative advancement: the tool advances by its clearance, because no point of the tool
/// moves farther than the origin moves plus the rotation times the bounding radius. So no contact is missed, and the
/// result is early by at most the time in which the tool moves sqrt(2) * kContactTolerance.
/// @param from, to  within the recording
std::optional<sweep_guard_core::Time> firstContact(const RecordedMotion& motion,
                                                   const sweep_guard_core::ConvexShape& tool,
                                                   const ClearanceAt& clearance, sweep_guard_core::Time from,
                                                   sweep_guard_core::Time to);

/// Does the same for a square.
std::optional<sweep_guard_core::Time> firstContact(const RecordedMotion& motion,
                                                   const sweep_guard_core::ConvexShape& tool,
                                                   const SquareObstacle& obstacle, sweep_guard_core::Time from,
                                                   sweep_guard_core::Time to);

}  // namespace sweep_guard_evaluation
