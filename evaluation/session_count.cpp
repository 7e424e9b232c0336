#include "evaluation/session_count.h"

#include <algorithm>

namespace sweep_guard_evaluation {

using std::chrono::milliseconds;
using sweep_guard_core::ConvexShape;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

namespace {

constexpr Duration kTouchStep = milliseconds(5);
constexpr Duration kCoarseStep = milliseconds(20);
constexpr double kDistanceTolerance = 1e-3;  // [m]

bool isContact(const ObjectSession& session, size_t touch) {
  const Time begin = session.touches[touch].begin;
  const bool again = touch > 0 && begin - session.touches[touch - 1].end < kSessionWindow;
  return !again && session.motion.isContinuous(begin - kSessionWindow, begin);
}

bool isOn(const std::vector<TimeInterval>& alarms, Time time) {
  return std::any_of(alarms.begin(), alarms.end(),
                     [&](const TimeInterval& alarm) { return alarm.begin <= time && alarm.end >= time; });
}

Time firstPoseFrom(const RecordedMotion& motion, Time time) {
  const size_t before = motion.newestAt(time);
  return motion.poses()[before].stamp == time ? time : motion.poses()[before + 1].stamp;
}

void countContact(const ObjectSession& session, Time contact, const std::vector<TimeInterval>& alarms,
                  SessionCount& count) {
  ++count.contacts;
  const auto on = std::find_if(alarms.begin(), alarms.end(), [&](const TimeInterval& alarm) {
    return alarm.begin <= contact && alarm.end >= contact;
  });
  for (size_t i = 0; i < kSessionLeads.size(); ++i) {
    if (on != alarms.end() && contact - on->begin >= sweep_guard_core::fromSeconds(kSessionLeads[i])) ++count.warned[i];
  }
  const Time known = firstPoseFrom(session.motion, contact);
  if (!isOn(session.levels.alarms(WarningLevel::kReflex), known)) ++count.late;
}

// The alarm comes from a sweep that began at the pose before it.
TimeInterval judgedInterval(const RecordedMotion& motion, const TimeInterval& alarm) {
  const Time end = std::min(std::max(alarm.end, alarm.begin + kSessionWindow), motion.poses().back().stamp);
  const size_t pose = motion.newestAt(alarm.begin);
  return {motion.poses()[pose == 0 ? 0 : pose - 1].stamp, end};
}

bool isJustified(const std::vector<TimeInterval>& touches, const TimeInterval& judged) {
  return std::any_of(touches.begin(), touches.end(),
                     [&](const TimeInterval& touch) { return touch.begin <= judged.end && touch.end >= judged.begin; });
}

void countAlarm(const ObjectSession& session, const TimeInterval& alarm, SessionCount& count) {
  ++count.alarms;
  const TimeInterval judged = judgedInterval(session.motion, alarm);
  if (isJustified(session.touches, judged)) return;
  ++count.unjustified;
  count.unjustified_time += alarm.end - alarm.begin;
  if (!session.measures_near_misses) return;
  const double nearest = nearestDistance(session.motion, session.tool, session.object, judged.begin, judged.end);
  for (size_t i = 0; i < kNearMisses.size(); ++i) {
    if (nearest < kNearMisses[i]) ++count.near_misses[i];
  }
}

}  // namespace

std::vector<TimeInterval> touchesOf(const RecordedMotion& motion, const ConvexShape& tool, ObstacleMesh& object) {
  const Time last = motion.poses().back().stamp;
  const ClearanceAt clearance = object.clearance();
  std::vector<TimeInterval> touches;
  Time from = motion.poses().front().stamp;
  while (const auto contact = firstContact(motion, tool, clearance, from, last)) {
    Time end = *contact;
    while (end < last && clearance(motion.at(end)) == 0.0) end = std::min(end + kTouchStep, last);
    touches.push_back({*contact, end});
    if (end == last) break;
    from = end;
  }
  return touches;
}

double nearestDistance(const RecordedMotion& motion, const ConvexShape& tool, ObstacleMesh& object, Time from,
                       Time to) {
  double nearest = object.distance(motion.at(to));
  for (Time time = from; time < to; time += kCoarseStep) nearest = std::min(nearest, object.distance(motion.at(time)));
  for (Time time = from; time < to && nearest > 0.0;) {
    const double distance = object.distance(motion.at(time));
    nearest = std::min(nearest, distance);
    const double left = distance - std::min(nearest, kExactDistance) + kDistanceTolerance;
    time = std::max(earliestArrival(motion, tool, time, to, left), time + Duration(1));
  }
  return nearest;
}

SessionCount& SessionCount::operator+=(const SessionCount& other) {
  contacts += other.contacts;
  for (size_t i = 0; i < warned.size(); ++i) warned[i] += other.warned[i];
  late += other.late;
  alarms += other.alarms;
  unjustified += other.unjustified;
  unjustified_time += other.unjustified_time;
  for (size_t i = 0; i < near_misses.size(); ++i) near_misses[i] += other.near_misses[i];
  return *this;
}

SessionCount countSession(const ObjectSession& session) {
  SessionCount count;
  const std::vector<TimeInterval> alarms = session.levels.alarms(WarningLevel::kConsidered);
  for (size_t i = 0; i < session.touches.size(); ++i) {
    if (isContact(session, i)) countContact(session, session.touches[i].begin, alarms, count);
  }
  for (const TimeInterval& alarm : alarms) {
    if (!session.motion.isContinuous(alarm.begin, alarm.begin + kSessionWindow)) continue;
    countAlarm(session, alarm, count);
  }
  return count;
}

}  // namespace sweep_guard_evaluation
