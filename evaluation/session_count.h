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
std::vector<TimeInterval> touchesOf(const RecordedMotion& motion, ObstacleMesh& object);

/// Returns the smallest distance of tool and object [m] from one time to another, to 1 mm. Beyond kExactDistance,
/// returns a lower bound that is no smaller.
/// @param from, to  within the recording
double nearestDistance(const RecordedMotion& motion, ObstacleMesh& object, sweep_guard_core::Time from,
                       sweep_guard_core::Time to);

/// Counts of one object in one session, or of several objects: of an operator who works beside one after the other, each for a
/// whole recording. Shares are in [0, 1].
struct SessionCount {
  size_t contacts = 0;
  std::array<size_t, kSessionLeads.size()> warned{};  ///< contacts warned of at least this early
  size_t late = 0;                                    ///< contacts without REFLEX, at the latest with the contact
  size_t alarms = 0;
  size_t unjustified = 0;
  sweep_guard_core::Duration unjustified_time{};         ///< for which the unjustified alarms were on
  std::array<size_t, kNearMisses.size()> near_misses{};  ///< unjustified alarms that were as near as this
  double minutes = 0.0;  ///< beside an object, set by sumOf(): those of the recording, once for each object

  double warnedShare(size_t lead) const;      ///< of contacts, by index of kSessionLeads; NaN without contacts
  double unjustifiedPerMinute() const;        ///< NaN without time
  double precision() const;                   ///< share of alarms that are justified; NaN without alarms
  double precisionWithin(size_t near) const;  ///< the same with near misses, by index of kNearMisses
  double falseOnShare() const;                ///< share of time in which an unjustified alarm is on

  SessionCount& operator+=(const SessionCount& other);
};

/// One object of a session, and when the tool touches it.
struct ObjectSession {
  ObstacleMesh mesh;
  std::vector<TimeInterval> touches;
  SessionCount count;
};

/// Counts contacts and alarms of one object. doc/tune.md has the definitions.
/// @param levels               of the warnings about the object
/// @param measure_near_misses  how near unjustified alarms were, which takes most of the time
void countSession(const RecordedMotion& motion, const sweep_guard_recording::LevelTrace& levels,
                  bool measure_near_misses, ObjectSession& object);

}  // namespace sweep_guard_evaluation
