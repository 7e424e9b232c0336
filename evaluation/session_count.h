#pragma once

#include <array>
#include <vector>

#include "evaluation/obstacle_mesh.h"
#include "evaluation/recorded_motion.h"
#include "recording/level_trace.h"

namespace sweep_guard_evaluation {

using sweep_guard_recording::TimeInterval;

/// An alarm is right if a contact follows its begin within this time. Touches that follow each other within this time
/// are one contact.
constexpr sweep_guard_core::Duration kSessionWindow = std::chrono::seconds(2);
constexpr std::array<double, 4> kSessionLeads = {0.1, 0.3, 0.5, 1.0};          // [s]
constexpr std::array<double, 3> kNearMisses = {0.010, 0.020, kExactDistance};  // [m]

/// Returns the intervals of the recorded motion in which the tool touches an object, in the order of time: `begin` is exact,
/// `end` late by at most 5 ms.
std::vector<TimeInterval> touchesOf(const RecordedMotion& motion, const sweep_guard_core::ConvexShape& tool,
                                    ObstacleMesh& object);

/// Returns the smallest distance of tool and object [m] from one time to another, to 1 mm. Beyond kExactDistance,
/// returns a lower bound that is no smaller.
/// @param from, to  within the recording
double nearestDistance(const RecordedMotion& motion, const sweep_guard_core::ConvexShape& tool, ObstacleMesh& object,
                       sweep_guard_core::Time from, sweep_guard_core::Time to);

/// Counts of one object in one session, or of several objects.
struct SessionCount {
  size_t contacts = 0;
  std::array<size_t, kSessionLeads.size()> warned{};  ///< contacts warned of at least this early
  size_t late = 0;                                    ///< contacts without REFLEX, at the latest with the contact
  size_t alarms = 0;
  size_t unjustified = 0;
  sweep_guard_core::Duration unjustified_time{};         ///< for which the unjustified alarms were on
  std::array<size_t, kNearMisses.size()> near_misses{};  ///< unjustified alarms that were as near as this

  SessionCount& operator+=(const SessionCount& other);
};

/// What is known of the levels of the warnings about one object, and of the truth.
struct ObjectSession {
  const RecordedMotion& motion;
  const sweep_guard_core::ConvexShape& tool;
  ObstacleMesh& object;
  const std::vector<TimeInterval>& touches;
  const sweep_guard_recording::LevelTrace& levels;
  bool measures_near_misses = true;  ///< how near unjustified alarms were, which takes most of the time
};

/// Counts contacts and alarms of one object. doc/warnings.md has the definitions.
SessionCount countSession(const ObjectSession& session);

}  // namespace sweep_guard_evaluation
